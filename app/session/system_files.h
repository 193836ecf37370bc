#pragma once
// What not every system can have: folders of the user's own, recordings, a command line. A program for another system,
// such as a browser, has another system_files.cpp.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/export/frame_writers.h"

namespace app::session {

/// Returns the kinds of recordings that this system can write, best first. There may be none.
std::span<const RecordingKind> recording_kinds();

/// Returns $XDG_CONFIG_HOME/sbcollide/preferences.toml, or the same in ~/.config; empty if neither folder is known.
std::filesystem::path preferences_path();

/// How a user starts the program and gets at files.
struct System {
  const char* how_to;         // what the user can do, in a line
  std::string_view start;     // what start_text() returns, for the user: "Command"
  std::string_view no_start;  // why there is none for a scene
  /// Returns what starts the program with these words of its command line; empty if nothing does.
  std::string (*start_text)(const std::vector<std::string>& words);
  void (*choose_files)();  // null: the user names files; else asks for files, which come as if they were dropped

  /// Returns false where the user has neither folders nor a command line.
  bool has_folders() const { return !choose_files; }
};
const System& this_system();

/// Gives the user a file that was written. Returns what it is called for him.
std::string hand_over(const std::filesystem::path& file);

}  // namespace app::session
