#include "app/session/scene_file.h"

#include <algorithm>
#include <array>

#include "app/files/output_file.h"
#include "softbody/scene/scene.h"
#include "softbody/scene/scene_keys.h"
#include "softbody/scene/toml_text.h"

namespace app::session {
namespace fs = std::filesystem;
namespace {

std::string three(const auto& values) {
  return softbody::toml_value(values[0]) + "," + softbody::toml_value(values[1]) + "," +
         softbody::toml_value(values[2]);
}

/// Returns the view in the form of --view.
std::string view_text(const softbody::View& v) {
  std::string text = three(v.target);
  for (const double value : {v.distance, v.azimuth, v.elevation}) text.append(",").append(softbody::toml_value(value));
  return text;
}

/// Returns an option with its value, with a space before each.
std::string option(const char* name, const std::string& value) {
  return std::string(" ").append(name).append(1, ' ').append(shell_word(value));
}

/// Returns the options for the view of `used`, and for how contacts are found.
std::string detection_options(const softbody::Scene& used) {
  const collide::Settings& c = used.collision;
  std::string text = option("--method", used.method) + option("--levels", std::to_string(c.levels)) +
                     option("--buckets", std::to_string(c.buckets)) +
                     option("--cell-size", c.cell_size ? three(*c.cell_size) : "auto");
  if (c.primes != collide::default_primes) text += option("--primes", three(c.primes));
  text += option("--tolerance", softbody::toml_value(c.tolerance)) + (c.self_collision ? " --self" : " --no-self");
  return text + option("--view", view_text(used.view));
}

/// Returns the options that make the scene `used`, for which `name` stands.
std::string scene_options(const std::string& name, const softbody::Scene& used,
                          const softbody::IntegratorChoice& integrator) {
  std::string text = option("--scene", name) + detection_options(used);
  for (const softbody::ContactSurfaceInfo& info : softbody::contact_surfaces)
    if (info.value == used.contact_surface) text += option("--contact-surface", std::string(info.key));
  if (integrator.key != softbody::default_integrator) text += option("--integrator", integrator.key);
  if (integrator.substeps) text += option("--substeps", std::to_string(*integrator.substeps));
  return text;
}

std::string this_program() {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  return shell_word(failed ? "sbcollide" : program.string());
}

}  // namespace

SceneFile::SceneFile(const std::string& key_or_path)
    : name_(key_or_path.ends_with(ending) ? fs::absolute(key_or_path).string() : key_or_path),
      known_time_(time_on_disk()) {}

SceneFile SceneFile::save(const softbody::Scene& scene, const fs::path& file) {
  if (file.extension() != ending) throw softbody::SceneError("a scene's file must end in .toml, e.g. scene.toml");
  files::write_file(file, softbody::scene_toml(scene, file.parent_path()));
  return SceneFile(file.string());
}

bool SceneFile::is_at(const fs::path& file) const {
  std::error_code missing;
  return fs::equivalent(file, name_, missing);
}

fs::file_time_type SceneFile::time_on_disk() const {
  std::error_code missing;
  return fs::last_write_time(name_, missing);
}

bool options_make(const softbody::Scene& used, const softbody::Scene& named) {
  softbody::Scene made = named;
  made.key = used.key;  // depends on the file's name
  made.view = used.view;
  using namespace softbody::scene_key;
  static constexpr std::array with_option{&method,    &levels,          &buckets,   &primes,
                                          &cell_size, &contact_surface, &tolerance, &self_collision};
  softbody::for_each_value(used, [&](const softbody::Key& key, const auto& value) {
    if (std::ranges::find(with_option, &key) != with_option.end()) softbody::set_value(made, key, value);
  });
  return made == used;
}

std::string shell_word(const std::string& text) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./,:=+@%";
  if (!text.empty() && text.find_first_not_of(plain) == text.npos) return text;
  std::string word = "'";
  for (const char c : text) c == '\'' ? word.append("'\\''") : word.append(1, c);
  return word + "'";
}

std::string demo_command(const std::string& name, const softbody::Scene& used,
                         const softbody::IntegratorChoice& integrator) {
  return this_program() + scene_options(name, used, integrator);
}

std::string play_command(const files::Playback& recording, const softbody::Scene& used) {
  std::string text = this_program();
  for (const std::string& word : recording.command_words()) text.append(1, ' ').append(shell_word(word));
  return text + detection_options(used);
}

std::string simulate_command(const std::string& name, const softbody::Scene& used,
                             const softbody::IntegratorChoice& integrator, int frame) {
  const std::string number = std::to_string(std::max(frame, 1));  // frame 0 has no picture
  return this_program() + " simulate" + scene_options(name, used, integrator) + " --frames " + number + " --capture " +
         number;
}

}  // namespace app::session
