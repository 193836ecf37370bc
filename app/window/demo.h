#pragma once
// The demo window: a world in motion with the panel beside it.

#include <filesystem>
#include <functional>
#include <optional>

#include <glm/vec2.hpp>

#include "app/compare/difference.h"
#include "app/files/playback.h"
#include "app/guest/guest.h"
#include "softbody/integrate/integrators.h"
#include "softbody/scene/scene.h"

namespace app::window {

struct DemoOptions {
  files::Opened opened;
  std::string scene_name;                             // its key or file
  bool scene_given = false;                           // else it is the default scene, which opens with the story
  std::filesystem::path scene_folder;                 // of the other scenes that the panel offers
  std::vector<std::string> meshes;                    // mesh files that are imported; they join a scene that is given
  std::vector<std::shared_ptr<guest::Guest>> guests;  // in the table of methods
  std::function<void(softbody::Scene&)> apply;        // the options of scenes, for the one in which meshes open
  softbody::IntegratorChoice integrator;
  std::optional<compare::HowSimulated> beside;  // the second world
  int threads = 1;
  std::optional<glm::ivec2> size;  // of the window, screen coordinates; else it has its last one
};

/// Runs until the window is closed. Throws engine::ContextError without a display, engine::ResourceError or
/// engine::ShaderError if the program's files are missing or broken, softbody::SceneError if the scene cannot be
/// simulated.
void run_demo(const DemoOptions& options);

}  // namespace app::window
