#pragma once
// The window and everything that draws in it.

#include <array>
#include <memory>

#include "app/render/canvas.h"
#include "app/render/scene_view.h"
#include "app/ui/widgets/dock.h"
#include "engine/context.h"
#include "engine/gui.h"
#include "engine/resources.h"
#include "engine/window.h"

namespace app::window {

/// Everything that lives in an OpenGL context and is made anew when the context is lost.
struct Graphics {
  /// threads: prepare a picture.
  Graphics(glm::ivec2 size, int threads)
      : window("Multi-Level SB Collide", size),
        renderer(std::make_shared<engine::render::Renderer>(engine::find_folder("shaders"))),
        views{render::SceneView(renderer, threads), render::SceneView(renderer, threads)} {}

  /// Clears the whole window to dock_colour().
  void clear() const {
    const ImVec4 colour = ui::dock_colour();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glClearColor(colour.x, colour.y, colour.z, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
  }

  engine::Window window;  // first: the others need its context
  engine::Gui gui{window};
  std::shared_ptr<engine::render::Renderer> renderer;
  std::array<render::SceneView, 2> views;  // by session::Half
  render::Canvas canvas{engine::uses_software_renderer()};
};

}  // namespace app::window
