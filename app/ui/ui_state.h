#pragma once
// What the user has opened and asked of the window; the rest of the demo's state is the Session's.

#include <array>
#include <cstddef>
#include <map>
#include <string>

#include "app/render/overlays.h"
#include "app/session/export/exporter.h"
#include "app/session/import.h"
#include "app/ui/tour/tour.h"

namespace app {

struct UiState {
  Overlays overlays;
  bool panel = true;
  bool table = true;   // the hash table's view
  bool sweep = false;  // error against run time
  bool help = false;
  bool light = false;         // the light of coverage is explained
  bool reset_camera = false;  // asked for; the main loop does it and clears this
  bool look_at_body = false;  // the selected one; likewise
  bool throw_body = false;    // likewise
  bool list_open = false;     // a list to choose from, in the last frame
  bool quit = false;
  float render_scale = 1;                // of the scene's picture, see Canvas
  std::map<std::string, bool> sections;  // of the panel: whether they are open, by their labels
  softbody::View view;                   // the camera, as a scene file has it
  Exporter exporter;
  Tour tour;
  Import import;
  std::string save_as = "scene.toml";      // where the scene is saved to
  std::size_t material = 0, solid = 0;     // whose values the panel shows
  std::array<double, 2> copied{-10, -10};  // when the commands were, in seconds of ImGui
};

}  // namespace app
