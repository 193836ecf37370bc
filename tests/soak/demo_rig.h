#pragma once
// The demo without a window: the work of its main loop, drawn off screen, with a simulated mouse.

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
  /// Everything that the demo writes goes to `folder`.
  DemoRig(const std::filesystem::path& scenes, const std::filesystem::path& folder);

  /// Runs one frame, a 60th of a second. `draw`: it draws the scene too.
  void frame(bool draw);
  void resize(glm::ivec2 size);
  /// Returns the ray from the eye through the middle of the picture.
  engine::Ray centre_ray() const { return mouse_.ray(camera_, input.display_size); }
  void restart_camera() { camera_ = view_.camera(session.world(), input.display_size); }

 private:
  engine::HeadlessContext context_;  // first: the others need it
  engine::Framebuffer target_{{640, 480}, 0};
  engine::Gui gui_{1.0f};
  app::render::SceneView view_;
  app::render::Canvas canvas_{true};
  app::ui::UserInterface interface_;
  app::window::SceneMouse mouse_;
  engine::Camera camera_;

 public:
  engine::GuiInput input{.display_size = {640, 480}};
  app::Session session;
  app::ui::UiState ui;
};

}  // namespace soak
