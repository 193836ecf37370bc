#include "app/session/scene_controls.h"

#include "app/files/inputs.h"
#include "app/session/system_files.h"

namespace app::session {
namespace {

std::vector<SceneChoice> list_scenes(const std::filesystem::path& folder) {
  std::vector<SceneChoice> list;
  for (const std::string& key : softbody::scene_keys(folder)) {
    try {
      const softbody::Scene scene = softbody::find_scene(key, folder);
      list.push_back({key, scene.name, scene.look_at});
    } catch (const softbody::SceneError& error) {
      list.push_back({key, key, error.what()});  // still listed: choosing it says what is wrong
    }
  }
  return list;
}

/// Returns none if the file is missing, or, with a notice, if it is damaged.
std::vector<softbody::Material> list_presets(const std::filesystem::path& file, Notice& notice) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  try {
    return softbody::load_presets(file);
  } catch (const softbody::SceneError& error) {
    notice.set("No presets of materials: " + std::string(error.what()));
    return {};
  }
}

}  // namespace

SceneControls::SceneControls(Simulation& simulation, std::filesystem::path folder)
    : simulation_(simulation),
      folder_(std::move(folder)),
      choices_(list_scenes(folder_)),
      presets_(list_presets(presets_file(), simulation.notice)) {
  files::protect_inputs(simulation_.loaded.scene);
  files::protect_input(presets_file());
}

void SceneControls::choose(const std::string& key_or_path) {
  try {
    softbody::Scene scene = softbody::find_scene(key_or_path, folder_);
    auto world = make_window_world(scene, {}, simulation_.threads);
    enter(std::move(world), std::move(scene), key_or_path);
  } catch (const std::exception& error) {
    simulation_.notice.set(error.what());
  }
}

void SceneControls::enter(ShownWorld world, softbody::Scene scene, const std::string& key_or_path, std::string change) {
  files::protect_inputs(scene);
  simulation_.enter(std::move(world), {std::move(scene), SceneFile(key_or_path)}, std::move(change));
}

softbody::Scene SceneControls::with_added_bodies() const {
  softbody::Scene scene = simulation_.world().scene();
  if (simulation_.simulated()) scene.bodies = simulation_.simulated()->body_sources();
  return scene;
}

std::string SceneControls::question_before_save(const std::filesystem::path& file) const {
  std::error_code ignored;
  if (file.extension() != SceneFile::ending || !std::filesystem::is_regular_file(file, ignored)) return {};
  const std::string name = file.filename().string();
  const SceneFile& own = simulation_.loaded.file;
  if (!own.is_at(file)) return name + " exists. Replace it?";
  return own.changed_on_disk() ? name + " has changed since this scene was loaded or saved. Replace it?" : "";
}

std::string SceneControls::save(const std::filesystem::path& file, const softbody::View& view) {
  softbody::Scene scene = with_added_bodies();
  scene.view = view;
  try {
    simulation_.loaded.file = SceneFile::save(scene, file);
    simulation_.loaded.scene = std::move(scene);
  } catch (const std::exception& error) {
    return error.what();
  }
  simulation_.notice.tell("Scene saved: " + hand_over(simulation_.loaded.file.name()));
  return {};
}

}  // namespace app::session
