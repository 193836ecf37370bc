#pragma once
// The window and all that is drawn with.

#include "app/render/canvas.h"
#include "app/render/scene_view.h"
#include "engine/context.h"
#include "engine/gui.h"
#include "engine/resources.h"
#include "engine/window.h"

namespace app {

/// All that lives in a context of OpenGL, and is made anew when the context is lost.
struct Screen {
  explicit Screen(glm::ivec2 size) : window({.title = "Multi-Level SB Collide", .size = size, .samples = 0}) {}

  /// The whole window, to the colour of what stands beside the scene.
  void clear() const;

  engine::Window window;  // before the others, which need its context
  engine::Gui gui{window};
  SceneView view{engine::find_folder("shaders")};
  Canvas canvas{engine::uses_software_renderer()};
};

}  // namespace app
