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

/// Returns `text` as one word of a POSIX shell, quoted only if needed.
std::string shell_word(const std::string& text) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./,:=+@%";
  if (!text.empty() && text.find_first_not_of(plain) == text.npos) return text;
  std::string word = "'";
  for (const char c : text) c == '\'' ? word.append("'\\''") : word.append(1, c);
  return word + "'";
}

/// Returns a command for a POSIX shell, with this executable.
std::string command(const std::vector<std::string>& words) {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  std::string text = shell_word(failed ? "sbcollide" : program.string());
  for (const std::string& word : words) text.append(1, ' ').append(shell_word(word));
  return text;
}

constexpr System desktop{
    .how_to = "Drag a body to pull it. Drag the background to orbit. B throws a body. G: tour. F1: help.",
    .start = "Command",
    .no_start = "The scene was changed: save it, so that a command can name it.",
    .start_text = &command,
    .choose_files = nullptr};

}  // namespace

const System& this_system() { return desktop; }

std::string hand_over(const fs::path& file) { return file.string(); }

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
