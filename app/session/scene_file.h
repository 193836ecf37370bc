#pragma once
// What a scene is called on the command line, and what that name stands for.

#include <filesystem>
#include <string>

#include "app/session/integrator_choice.h"
#include "softbody/scene.h"

namespace app {

class SceneFile {
 public:
  SceneFile() = default;
  /// key_or_path: as --scene takes it; content: what it holds, but for settings that the command line has options for.
  SceneFile(const std::string& key_or_path, softbody::Scene content);

  /// Writes a scene to a file, whole or not at all. Throws SceneError or UsageError.
  static SceneFile save(softbody::Scene scene, const std::filesystem::path& file);

  /// What --scene finds it by from any folder: a key, or an absolute path.
  const std::string& name() const { return name_; }
  /// Whether the scene of this name and options of the command line make the scene `used`.
  bool reproduces(const softbody::Scene& used) const;

 private:
  std::string name_;
  softbody::Scene content_;
};

/// The shortest word, or quoted string, that a POSIX shell takes for `text`.
std::string shell_word(const std::string& text);

// Commands for a POSIX shell, with this executable: the demo with a scene of that name and the settings of `used`, and
// the run without a window that takes a picture of the frame.
std::string demo_command(const std::string& name, const softbody::Scene& used, const IntegratorChoice& integrator);
std::string simulate_command(const std::string& name, const softbody::Scene& used, const IntegratorChoice& integrator,
                             int frame);

}  // namespace app
