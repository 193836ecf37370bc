#pragma once
// How the demo begins.

#include <memory>

#include "app/session/session.h"
#include "app/window/demo.h"
#include "app/window/screen.h"

namespace app {

/// The session that the options ask for. The balance of a large mesh takes long to find: meanwhile the window says so;
/// closed, it ends the program. Throws softbody::SceneError if the scene cannot be simulated.
std::unique_ptr<Session> open_session(const DemoOptions& options, Screen& screen);

}  // namespace app
