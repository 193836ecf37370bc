#include "app/session/scene_file.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "app/base/text.h"
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

struct Option {
  std::string name, value;
  bool operator==(const Option&) const = default;
};

/// Returns the options for how contacts are found.
std::vector<Option> detection_options(const softbody::Scene& used) {
  const collide::Settings& c = used.collision;
  return {{"method", used.method},
          {"levels", std::to_string(c.levels)},
          {"buckets", std::to_string(c.buckets)},
          {"cell-size", c.cell_size ? three(*c.cell_size) : "auto"},
          {"tolerance", softbody::toml_value(c.tolerance)}};
}

/// Returns the options in which a second world may differ.
std::vector<Option> world_options(const compare::HowSimulated& how) {
  std::vector<Option> options = detection_options(how.scene);
  const auto surface =
      std::ranges::find(softbody::contact_surfaces, how.scene.contact_surface, &softbody::ContactSurfaceInfo::value);
  options.push_back({"contact-surface", std::string(surface->key)});
  options.push_back({"integrator", how.integrator.key});
  return options;
}

/// Returns the words for these options, for the view of `used`, and for what only one world can have.
std::vector<std::string> words_of(const std::vector<Option>& options, const softbody::Scene& used) {
  std::vector<std::string> words;
  for (const auto& [name, value] : options) words.insert(words.end(), {"--" + name, value});
  if (const auto& primes = used.collision.primes; primes != collide::default_primes)
    words.insert(words.end(), {"--primes", three(primes)});
  words.insert(words.end(), {used.collision.self_collision ? "--self" : "--no-self", "--view", view_text(used.view)});
  return words;
}

/// Returns the value of --beside; empty if the second world is as the first.
std::string beside_text(const std::vector<Option>& first, const std::vector<Option>& second) {
  std::vector<std::string> differences;
  for (std::size_t i = 0; i < first.size(); ++i)
    if (first[i] != second[i]) differences.push_back(second[i].name + "=" + second[i].value);
  return joined(differences, ",");
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

std::vector<std::string> demo_words(const std::string& name, const compare::HowSimulated& used,
                                    const std::optional<compare::HowSimulated>& beside) {
  const std::vector<Option> options = world_options(used);
  std::vector<std::string> words{"--scene", name};
  std::ranges::move(words_of(options, used.scene), std::back_inserter(words));
  if (const auto substeps = used.integrator.substeps)
    words.insert(words.end(), {"--substeps", std::to_string(*substeps)});
  if (const std::string differs = beside ? beside_text(options, world_options(*beside)) : ""; !differs.empty())
    words.insert(words.end(), {"--beside", differs});
  return words;
}

std::vector<std::string> play_words(const files::Playback& recording, const softbody::Scene& used) {
  std::vector<std::string> words = recording.command_words();
  std::ranges::move(words_of(detection_options(used), used), std::back_inserter(words));
  return words;
}

std::vector<std::string> simulate_words(const std::vector<std::string>& demo, int frame) {
  std::vector<std::string> words{"simulate"};
  std::ranges::copy(demo, std::back_inserter(words));
  const std::string number = std::to_string(std::max(frame, 1));  // frame 0 has no picture
  words.insert(words.end(), {"--frames", number, "--capture", number});
  return words;
}

}  // namespace app::session
