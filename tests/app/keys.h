#pragma once
// Keys pressed in tests.

#include "app/ui/state/shortcuts.h"

namespace app {

/// Carries out what a key asks for, but for what is left to the window. Returns false if the key has no shortcut.
inline bool handle_key(int key, bool repeat, Session& session, ui::UiState& state, int mods = 0) {
  const auto request = ui::request_by_key(session, key, repeat, mods);
  if (request) ui::carry_out({*request}, session, state);
  return request.has_value();
}

}  // namespace app
