#pragma once
// The demo without a window: what its main loop does in a frame, drawn off screen, with a mouse that is told what to
// do.

#include <filesystem>

#include "app/render/canvas.h"
#include "app/render/scene_view.h"
#include "app/ui/user_interface.h"
#include "app/window/scene_mouse.h"
#include "engine/gl.h"
#include "engine/gui.h"
#include "engine/headless.h"

namespace soak {

class DemoRig {
 public:
  /// Works in `folder`, where all goes that the demo writes.
  DemoRig(const std::filesystem::path& scenes, const std::filesystem::path& folder);

  /// A 60th of a second; `draw`: with the scene's picture.
  void frame(bool draw);
  void resize(glm::ivec2 size);
  /// From the eye through the middle of the picture.
  engine::Ray middle() const { return mouse_.ray(camera_, input.display_size); }
  void restart_camera() { camera_ = view_.camera(session.world().scene(), input.display_size); }

 private:
  engine::HeadlessContext context_;  // first: the others need it
  engine::Framebuffer target_{{640, 480}, 0};
  engine::Gui gui_{1.0f};
  app::SceneView view_;
  app::Canvas canvas_{true};
  app::UserInterface interface_;
  app::SceneMouse mouse_;
  engine::Camera camera_;

 public:
  engine::GuiInput input{.display_size = {640, 480}};
  app::Session session;
  app::UiState ui;
};

}  // namespace soak
