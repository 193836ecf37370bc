#pragma once
// What the user has opened and asked of the window; the rest of the demo's state is the Session's.

namespace app {

struct UiState {
  bool panel = true;
  bool table = true;   // the hash table's view
  bool sweep = false;  // error against run time
  bool help = false;
  bool reset_camera = false;  // asked for; the main loop does it and clears this
  bool quit = false;
};

}  // namespace app
