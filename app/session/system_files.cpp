#include "app/session/system_files.h"

#include <array>
#include <cstdlib>

namespace app::session {
namespace fs = std::filesystem;
namespace {

constexpr std::array<RecordingKind, 3> kinds{{
    {"video", "Video", "An MP4 file, 60 pictures a second, by ffmpeg.", true, &make_video_writer},
    {"pictures", "Pictures", "A folder of PNG files, one a frame of the world.", true, &make_picture_writer},
    {"motion", "Motion (OBJ)",
     "A folder of OBJ files, one a frame of the world, each body an object; `sbcollide detect` reads them back.", false,
     &make_motion_writer},
}};

/// Returns an absolute path from the environment. The XDG specification asks to ignore relative ones.
fs::path folder_in(const char* variable) {
  const char* value = std::getenv(variable);
  const fs::path folder = value ? value : "";
  return folder.is_absolute() ? folder : fs::path();
}

}  // namespace

std::span<const RecordingKind> recording_kinds() { return kinds; }

fs::path preferences_path() {
  fs::path folder = folder_in("XDG_CONFIG_HOME");
  if (folder.empty()) {
    folder = folder_in("HOME");
    if (folder.empty()) return {};
    folder /= ".config";
  }
  return folder / "sbcollide" / "preferences.toml";
}

}  // namespace app::session
