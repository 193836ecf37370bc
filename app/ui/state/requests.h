#pragma once
// What the user asks for by the interface, by keys and by the mouse in the scene, as values. These see a session and a
// state that they cannot change; carry_out() is the one place where requests change them.

#include <functional>
#include <type_traits>
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
  throw_body,           // to where the mouse points
  switch_hold,          // of the selected body's vertex there
  show_highlight,       // of the tour
  show_as_before_tour,  // while the world runs ahead
  show_first_missed,    // of the pairs that CompareChoice::misses_of missed in the last report
  show_first_false      // of those that it found there
};

/// A change of the session or of what the window shows, or a task for the window.
using Request = std::variant<std::function<void(session::Session&, UiState&)>, WindowTask>;
/// In the order in which they were asked.
using Requests = std::vector<Request>;

/// Adds a request: a task of the window, or a change of the session, of what the window shows, or of both: a function
/// of Session&, UiState&, or both in this order.
template <class Asked>
void ask(Requests& requests, const Asked& asked) {
  if constexpr (std::is_invocable_v<Asked, session::Session&>)
    requests.emplace_back([asked](session::Session& s, UiState&) { asked(s); });
  else if constexpr (std::is_invocable_v<Asked, UiState&>)
    requests.emplace_back([asked](session::Session&, UiState& ui) { asked(ui); });
  else
    requests.emplace_back(asked);
}

/// Carries out the requests, in order. Then lets the tour follow the world, and tells the session what the window wants
/// to have worked out. To be called for the keys, the interface and the mouse of each picture. Returns what is left for
/// the window.
std::vector<WindowTask> carry_out(const Requests& requests, session::Session& session, UiState& ui);

}  // namespace app::ui
