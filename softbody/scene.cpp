#include "softbody/scene.h"

#include <algorithm>
#include <utility>

namespace softbody {
namespace {

std::string without_controls(std::string message) {
  std::ranges::replace_if(
      message, [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return message;
}

}  // namespace

SceneError::SceneError(std::string message) : std::runtime_error(without_controls(std::move(message))) {}

MeshSource MeshSource::from_file(const MeshFile& file) {
  MeshSource source;
  source.kind = "file";
  source.file = file;
  source.imported = std::make_shared<const ImportedMesh>(import_mesh(file));
  return source;
}

Mesh MeshSource::make() const {
  if (kind == "file") return imported->mesh;
  return kind == "grid" ? quad_grid(columns, rows, width, depth) : icosphere(subdivisions, radius);
}

std::uint64_t MeshSource::vertex_count() const {
  if (kind == "file") return imported->mesh.vertices.size();
  return kind == "grid" ? std::uint64_t(columns + 1) * std::uint64_t(rows + 1) : 10 * (1ull << (2 * subdivisions)) + 2;
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
