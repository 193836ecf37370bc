#pragma once
// The keyboard shortcuts: one table that handle_key() runs and the help lists.

#include <span>

#include "app/session/session.h"
#include "app/ui/panel/ui_state.h"

namespace app::ui {

struct Shortcut {
  int key, other_key;          // GLFW_KEY_* or a character, as in engine::KeyPress; other_key 0: none
  std::string_view keys_text;  // the keys, in the help; empty: another row mentions them
  std::string_view text;       // what they do, in the help
  void (*act)(Session& session, UiState& ui);
  bool repeats = false;       // also acts repeatedly while the key is held
  int mods = 0;               // GLFW_MOD_* that must be down
  bool needs_solver = false;  // left out where the motion is recorded
};

/// All shortcuts except the overlays' digits, which are in overlay_table.
std::span<const Shortcut> shortcuts();

/// Runs the shortcut of a key. Returns false if the key has none.
bool handle_key(int key, bool repeat, Session& session, UiState& ui, int mods = 0);

/// A line of the help.
struct HelpLine {
  std::string_view input, text;  // keys or a use of the mouse, and what they do
};
/// Returns the uses of the mouse over the scene.
std::span<const HelpLine> mouse_actions();

}  // namespace app::ui
