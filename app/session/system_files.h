#pragma once
// The files that not every system can have. A program for another system, such as a browser, has another
// system_files.cpp.

#include <filesystem>
#include <span>

#include "app/session/export/frame_writers.h"

namespace app::session {

/// Returns the kinds of recordings that this system can write, best first.
std::span<const RecordingKind> recording_kinds();

/// Returns $XDG_CONFIG_HOME/sbcollide/preferences.toml, or the same in ~/.config; empty if neither folder is known.
std::filesystem::path preferences_path();

}  // namespace app::session
