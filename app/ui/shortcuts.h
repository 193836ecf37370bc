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

/// A use of the mouse over the scene, for the help.
struct MouseAction {
  std::string_view mouse_text, text;
};
std::span<const MouseAction> mouse_actions();

}  // namespace app::ui
