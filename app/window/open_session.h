#pragma once
// Makes the demo's first session.

#include <memory>

#include "app/session/session.h"
#include "app/window/demo.h"
#include "app/window/graphics.h"

namespace app::window {

/// Returns the session that the options ask for. A large mesh takes long to bring into equilibrium: the window shows
/// the time meanwhile, and closing it ends the program. Throws softbody::SceneError if the scene cannot be simulated.
std::unique_ptr<Session> open_session(const DemoOptions& options, Graphics& graphics);

}  // namespace app::window
