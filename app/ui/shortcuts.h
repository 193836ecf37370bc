#pragma once
// The keyboard: one table that acts, and that the help overlay lists.

#include <span>

#include "app/session/session.h"
#include "app/ui/ui_state.h"

namespace app {

struct Shortcut {
  int key, other_key;      // GLFW_KEY_* or a sign, as in engine::KeyPress; other_key 0: none
  std::string_view label;  // of the keys, in the help
  std::string_view what;
  void (*act)(Session& session, UiState& ui);
  bool repeats = false;  // also while the key is held
  int mods = 0;          // GLFW_MOD_*, which must be down
};

/// All but the overlays' digits, which are in overlay_table.
std::span<const Shortcut> shortcuts();

/// Does what the key is for; false if it is for nothing.
bool press(int key, bool repeat, Session& session, UiState& ui, int mods = 0);

/// Mouse buttons and wheel over the scene, for the help.
struct MouseUse {
  std::string_view label, what;
};
std::span<const MouseUse> mouse_uses();

}  // namespace app
