#pragma once
// The keyboard shortcuts: one table in which request_by_key() looks and which the help lists.

#include <span>

#include "app/ui/state/requests.h"
#include "app/ui/state/ui_state.h"

namespace app::ui {

struct Shortcut {
  int key, other_key;          // GLFW_KEY_* or a character, as in engine::KeyPress; other_key 0: none
  std::string_view keys_text;  // the keys, in the help; empty: another row mentions them
  std::string_view text;       // what they do, in the help
  std::variant<void (*)(Session& session, UiState& ui), WindowTask> act;
  bool repeats = false;       // also acts repeatedly while the key is held
  int mods = 0;               // GLFW_MOD_* that must be down
  bool needs_solver = false;  // left out where the motion is recorded
  // What switches something on and off has a check box with this tooltip on the panel, below *More* if it is rare.
  bool (*is_on)(const Session& session, const UiState& ui) = nullptr;
  std::string_view tooltip{};
  bool rare = false;
};

/// All shortcuts except the overlays' digits, which are in overlay_table.
std::span<const Shortcut> shortcuts();

/// Returns what a key asks for; nothing if it has no shortcut.
std::optional<Request> request_by_key(const Session& session, int key, bool repeat, int mods = 0);

/// A line of the help.
struct HelpLine {
  std::string_view input, text;  // keys or a use of the mouse, and what they do
};
/// Returns the uses of the mouse over the scene.
std::span<const HelpLine> mouse_actions();

}  // namespace app::ui
