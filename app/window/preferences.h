#pragma once
// What the demo remembers from one start to the next, in the platform's folder for such files.

#include <filesystem>
#include <map>
#include <string>

#include <glm/vec2.hpp>

#include "app/session/session.h"
#include "app/ui/ui_state.h"

namespace app {

struct Preferences {
  glm::ivec2 size{1280, 720};  // of the window, as WindowOptions::size
  Overlays overlays;
  bool panel = true, table = true, sweep = false, compare = false;
  bool picture_with_panel = false;
  double slow_factor = 0.1;
  std::map<std::string, bool> sections;  // of the panel: whether they are open

  bool operator==(const Preferences&) const = default;
};

Preferences preferences_of(const Session& session, const UiState& ui, glm::ivec2 size);
void apply(const Preferences& preferences, Session& session, UiState& ui);  // all but the size

/// $XDG_CONFIG_HOME/sbcollide/preferences.toml, or the same in ~/.config; empty if there is no such place.
std::filesystem::path preferences_path();

class PreferencesFile {
 public:
  /// Reads them; what is missing has its default. A file that is broken counts as empty, and problem() says so.
  explicit PreferencesFile(std::filesystem::path file);

  const Preferences& kept() const { return kept_; }
  /// Writes them if they are others than before and have stayed the same for some seconds, or if it is the last time.
  /// `seconds`: a clock's. Never throws: problem() says what is wrong, and the file stays as it was.
  void keep(const Preferences& now, double seconds, bool last = false);
  /// Empty, or one line for the user, once.
  std::string take_problem() { return std::exchange(problem_, {}); }

 private:
  void write();

  static constexpr double settled = 2;  // s

  std::filesystem::path file_;
  Preferences kept_, next_;
  double changed_ = 0;  // when next_ became what it is
  std::string problem_;
};

}  // namespace app
