#pragma once
// What the user does with scenes: choose and save them.

#include <filesystem>

#include "app/session/simulation.h"

namespace app::session {

struct SceneChoice {
  std::string key, name, look_at;
};

class SceneControls {
 public:
  /// `folder`: where scenes are found by their keys.
  SceneControls(Simulation& simulation, std::filesystem::path folder);

  const std::vector<SceneChoice>& choices() const { return choices_; }
  /// Materials to choose from.
  const std::vector<softbody::Material>& presets() const { return presets_; }
  /// Their file.
  std::filesystem::path presets_file() const { return softbody::presets_path(folder_); }
  /// Loads another scene with its own settings. On an error the present one stays, and the notice says why.
  void choose(const std::string& key_or_path);
  /// The same with what shows that scene, made elsewhere with the simulation's threads(). `change`: the name for undo.
  /// Throws UsageError or std::filesystem::filesystem_error, and changes nothing then.
  void enter(ShownWorld world, softbody::Scene scene, const std::string& key_or_path,
             std::string change = "choice of scene");
  /// The scene as it is now: the settings in use, and added bodies and changed holds, each in its frame.
  softbody::Scene with_added_bodies() const;
  /// Returns a question for the user if save() would replace a file that is not the scene's own, or that has changed
  /// since the scene was loaded or saved; else an empty text.
  std::string question_before_save(const std::filesystem::path& file) const;
  /// Writes with_added_bodies(), seen from `view`, to a file, which is the scene's file from then on. Returns what is
  /// wrong, and then has written nothing; else an empty text, and the notice names the file.
  std::string save(const std::filesystem::path& file, const softbody::View& view);

 private:
  Simulation& simulation_;
  std::filesystem::path folder_;
  std::vector<SceneChoice> choices_;
  std::vector<softbody::Material> presets_;
};

}  // namespace app::session
