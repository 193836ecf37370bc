#pragma once
// What the user asks for by the interface and by keys, as values. The interface is drawn from a session and a state
// that it cannot change; carry_out() is the one place where requests change them.

#include <functional>
#include <variant>
#include <vector>

namespace app::session {
class Session;
}

namespace app::ui {

struct UiState;

/// What only the window can do, most of it because it has the camera.
enum class WindowTask {
  quit,
  reset_camera,
  show_selected_body,
  throw_body,          // to where the mouse points
  show_joined,         // the body that was imported last
  show_highlight,      // of the tour
  show_as_before_tour  // while the world runs ahead
};

/// A change of the session or of what the window shows, or a task for the window.
using Request = std::variant<std::function<void(session::Session&, UiState&)>, WindowTask>;
/// In the order in which they were asked.
using Requests = std::vector<Request>;

/// Carries out the requests, in order. Then lets the tour follow the world, and tells the session what the window wants
/// to have worked out. To be called before and after each drawing. Returns what is left for the window.
std::vector<WindowTask> carry_out(const Requests& requests, session::Session& session, UiState& ui);

}  // namespace app::ui
