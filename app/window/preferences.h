#pragma once
// What the demo remembers from one start to the next, in the file session::preferences_path().

#include <filesystem>
#include <string>

#include <glm/vec2.hpp>

#include "app/session/session.h"
#include "app/ui/state/ui_state.h"

namespace app::window {

struct Preferences {
  glm::ivec2 size{1280, 720};  // of the window, screen coordinates
  ui::Remembered shown;
  bool picture_with_panel = false;
  double slow_factor = 0.1;
  compare::MethodSet methods = compare::usual_methods();  // that are shown side by side

  bool operator==(const Preferences&) const = default;
};

/// Returns what is open at the first start: where space is short, less is.
Preferences first_preferences(glm::ivec2 size);
Preferences preferences_of(const Session& session, const ui::UiState& ui, glm::ivec2 size);
/// Applies everything except the window's size.
void apply(const Preferences& preferences, Session& session, ui::UiState& ui);

class PreferencesFile {
 public:
  /// Reads the file. Missing values get their defaults. A broken file counts as empty, and the first store() says so.
  explicit PreferencesFile(std::filesystem::path file);

  const Preferences& stored() const { return stored_; }
  /// Returns true if there was no file.
  bool is_new() const { return is_new_; }
  /// Writes the preferences if they differ from the stored ones and have not changed for some seconds, or if this is
  /// the last call (`last`). `seconds`: a clock's time. Never throws: on failure the file stays as it was. Returns one
  /// line for the user, what went wrong since the last call; empty if nothing did.
  std::string store(const Preferences& now, double seconds, bool last = false);

 private:
  static constexpr double settling = 2;  // s

  std::filesystem::path file_;
  Preferences stored_, pending_;
  bool is_new_ = true;
  double pending_since_ = 0;  // s
  std::string problem_;
};

}  // namespace app::window
