#include "softbody/scene/scene.h"

#include <algorithm>

#include "softbody/mechanics/material_keys.h"
#include "softbody/mesh/shortest_text.h"
#include "softbody/scene/scene_keys.h"

namespace softbody {

std::string problem(const Scene& scene) {
  std::string found = problem(scene.collision);
  if (!collide::find_driver(scene.method)) found = "method must be one of: " + collide::method_keys();
  const auto check = [&](const std::string& name, Key::Limits limits, double value) {
    const auto [least, most] = limits;  // as floats, of which some of the values are
    if (float(value) >= float(least) && float(value) <= float(most)) return;
    found = name + " is " + shortest_text(value) + "; it must be from " + shortest_text(least) + " to " +
            shortest_text(most);
  };
  for_each_value(scene, [&](const Key& key, const auto& value) {
    for (const double number : numbers_of(value)) check(std::string(key.name), key.limits, number);
  });
  for (const Material& m : scene.materials)
    for (const Key* key : material_keys())
      if (m.given(*key)) check("material " + m.name + ": " + std::string(key->name), key->limits, m[*key]);
  for (Solid s : scene.solids) {
    const std::string of = std::string(s.traits().key) + ": ";
    check(of + "friction", s.friction_limits, s.friction);
    check(of + "restitution", s.restitution_limits, s.restitution);
    s.values([&]<class Value>(const char* key, Value v) {
      if constexpr (requires { Value::Kind::limits; })
        for (const double number : numbers_of(v.value)) check(of + key, Value::Kind::limits, number);
      else if (!solid::is_valid(v.value))
        found = of + key + " must consist of directions of length 1, at right angles to each other";
    });
  }
  return found;
}

std::vector<std::string> scene_keys(const std::filesystem::path& folder) {
  std::vector<std::string> keys;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".toml") keys.push_back(entry.path().stem().string());
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::filesystem::path scene_path(const std::string& name, const std::filesystem::path& folder) {
  if (name.ends_with(".toml")) return name;
  const auto keys = scene_keys(folder);
  if (std::find(keys.begin(), keys.end(), name) != keys.end()) return folder / (name + ".toml");
  std::string known;
  for (const auto& key : keys) known.append(known.empty() ? "" : ", ").append(key);
  throw SceneError("unknown scene '" + name + "'; use one of: " + known + "; or the path of a .toml file");
}

Scene find_scene(const std::string& name, const std::filesystem::path& folder) {
  return load_scene(scene_path(name, folder), presets_path(folder));
}

std::filesystem::path presets_path(const std::filesystem::path& folder) {
  return folder.parent_path() / "materials.toml";
}

const ContactSurfaceInfo* find_contact_surface(std::string_view key) {
  for (const ContactSurfaceInfo& c : contact_surfaces)
    if (c.key == key) return &c;
  return nullptr;
}

std::string contact_surface_keys() {
  std::string keys;
  for (const ContactSurfaceInfo& c : contact_surfaces) keys.append(keys.empty() ? "" : ", ").append(c.key);
  return keys;
}

}  // namespace softbody
