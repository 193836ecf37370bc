#pragma once
// The name of a scene on the command line, and the scene that it stands for.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/compare/difference.h"
#include "app/files/playback.h"
#include "softbody/scene/scene.h"

namespace app::session {

class SceneFile {
 public:
  static constexpr std::string_view ending = ".toml";

  SceneFile() = default;
  /// key_or_path: in the form of --scene.
  explicit SceneFile(const std::string& key_or_path);

  /// Writes a scene to a file, which becomes complete or stays as it was. Throws SceneError or UsageError.
  static SceneFile save(const softbody::Scene& scene, const std::filesystem::path& file);

  /// Returns the name by which --scene finds it from any folder: a key, or an absolute path.
  const std::string& name() const { return name_; }
  /// Returns true if the scene's file is this one, under any path or link.
  bool is_at(const std::filesystem::path& file) const;
  /// Returns true if the scene's file is not the one any more that was read or written.
  bool changed_on_disk() const { return time_on_disk() != known_time_; }

 private:
  std::filesystem::file_time_type time_on_disk() const;

  std::string name_;
  std::filesystem::file_time_type known_time_{};
};

/// Returns true if command-line options make the scene `used` of `named`.
bool options_make(const softbody::Scene& used, const softbody::Scene& named);

// Return words of the command line, see system().start_text:
/// To open the demo with the scene of that name and the settings in use, and with the second world beside it, if any.
std::vector<std::string> demo_words(const std::string& name, const compare::HowSimulated& used,
                                    const std::optional<compare::HowSimulated>& beside = {});
/// To open the demo with a recording and the settings of `used`.
std::vector<std::string> play_words(const files::Playback& recording, const softbody::Scene& used);
/// To take a picture of the scene's frame without a window. demo: the demo_words().
std::vector<std::string> simulate_words(const std::vector<std::string>& demo, int frame);

}  // namespace app::session
