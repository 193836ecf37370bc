// Writes scene files, in the order in which scene_toml.cpp reads them.

#include <algorithm>
#include <utility>

#include "softbody/mechanics/material_keys.h"
#include "softbody/scene/scene.h"
#include "softbody/scene/scene_keys.h"
#include "softbody/scene/solid_toml.h"
#include "softbody/scene/toml_table.h"
#include "softbody/scene/toml_text.h"

namespace softbody {
namespace fs = std::filesystem;
namespace {

// These write the value of a key, unless nothing was given for it.
void write(TomlLines& out, const Key& key, const auto& value) { out.add(key.own_name(), value); }
void write(TomlLines& out, const Key& key, const std::optional<glm::vec3>& value) {
  if (value) out.add(key.own_name(), *value);
}
void write(TomlLines& out, const Key& key, const std::array<std::uint32_t, 3>& value) {
  out.add(key.own_name(), glm::dvec3(value[0], value[1], value[2]));
}
void write(TomlLines& out, const Key& key, ContactSurface value) {
  out.add(key.own_name(), std::ranges::find(contact_surfaces, value, &ContactSurfaceInfo::value)->key);
}

void write_values(TomlLines& out, const Scene& scene) {
  std::string_view table;
  for_each_value(scene, [&](const Key& key, const auto& value) {
    if (std::exchange(table, key.table()) != key.table()) out.heading(std::string("[").append(table).append("]"));
    write(out, key, value);
  });
}

void write_material(TomlLines& out, const Material& m) {
  out.heading("[[material]]").add("name", m.name);
  const auto add = [&m](auto& lines, const Key& key) {
    if (!m.given(key)) return;
    if (key.options.is_switch)
      lines.add(key.own_name(), m[key] != 0);
    else
      lines.add(key.own_name(), m[key]);
  };
  const auto keys = material_keys();
  for (auto key = keys.begin(); key != keys.end();) {
    const std::string_view name = (*key)->table();
    if (name.empty()) {
      add(out, **key++);
      continue;
    }
    TomlInline inside;
    for (; key != keys.end() && (*key)->table() == name; ++key) add(inside, **key);
    out.add(name, inside);
  }
}

/// Returns a path relative to the scene file's folder, with the links in both paths resolved.
std::string relative_path(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path relative = fs::relative(file, folder.empty() ? fs::path(".") : folder, error);
  return (error || relative.empty() ? fs::absolute(file) : relative).generic_string();
}

TomlInline mesh(const MeshSource& m, const fs::path& folder) {
  TomlInline out;
  out.add("kind", m.kind);
  if (m.kind == "icosphere") return out.add("subdivisions", m.subdivisions).add("radius", m.radius);
  if (m.kind == "grid")
    return out.add("columns", m.columns).add("rows", m.rows).add("width", m.width).add("depth", m.depth);
  out.add("path", relative_path(m.file.path, folder));
  if (m.file.size > 0) out.add("size", m.file.size);
  out.add("weld", m.file.weld).add("up", m.file.up);
  if (m.file.resolution > 0) out.add("resolution", static_cast<int>(m.file.resolution));
  return out;
}

TomlInline spin(const Spin& s) {
  return TomlInline().add("axis", s.axis).add("degrees_per_second", s.degrees_per_second);
}

TomlInline hold(const Hold& h) {
  TomlInline out;
  if (!h.vertices.empty())
    out.add("vertices", h.vertices);
  else
    out.add(std::holds_alternative<SolidBox>(h.where) ? "box" : "sphere", write_shape(h.where));
  if (h.from > 0) out.add("from", h.from);
  if (h.until > 0) out.add("until", h.until);
  if (h.velocity != glm::dvec3(0.0)) out.add("velocity", h.velocity);
  if (h.turn != Spin() || h.through != glm::dvec3(0.0)) out.add("turn", spin(h.turn).add("through", h.through));
  return out;
}

void write_body(TomlLines& out, const BodySource& b, const Scene& scene, const fs::path& folder) {
  out.add("mesh", mesh(b.mesh, folder));
  out.add("material", scene.materials[std::size_t(b.material)].name);
  out.add("position", b.position);
  write_rotation(out, "rotation", b.axes);
  if (b.velocity != glm::dvec3(0.0)) out.add("velocity", b.velocity);
  if (b.spin != Spin()) out.add("spin", spin(b.spin));
}

void write_bodies(TomlLines& out, const Scene& scene, const fs::path& folder) {
  for (const BodySource& b : scene.bodies) {
    out.heading("[[body]]");
    write_body(out, b, scene, folder);
    if (b.appear != 0) out.add("appear", b.appear);
    if (b.release != b.appear) out.add("release", b.release);
    if (b.holds.empty()) continue;
    std::vector<TomlInline> holds;
    std::ranges::transform(b.holds, std::back_inserter(holds), hold);
    out.add("hold", holds);
  }
  if (!scene.dropper) return;
  out.heading("[dropper]");
  write_body(out, scene.dropper->body, scene, folder);
  out.add("spread", scene.dropper->spread);
}

void write_view(TomlLines& out, const Scene& scene) {
  const View& v = scene.view;
  out.heading("[view]").add("target", v.target).add("distance", v.distance);
  out.add("azimuth", v.azimuth).add("elevation", v.elevation);
  for (const Caption& c : scene.captions) out.heading("[[caption]]").add("frame", c.frame).add("text", c.text);
}

/// Throws SceneError if two materials have the same name, since bodies refer to materials by name.
void require_different_names(const Scene& scene) {
  for (auto m = scene.materials.begin(); m != scene.materials.end(); ++m)
    if (std::ranges::count(scene.materials, m->name, &Material::name) > 1)
      throw SceneError("two materials are called '" + m->name + "'; a scene file needs different names");
}

}  // namespace

std::string scene_toml(const Scene& scene, const fs::path& folder) {
  if (scene.bodies.empty() && !scene.dropper) throw SceneError("a scene without a body cannot be saved; add one");
  require_different_names(scene);
  TomlLines out;
  out.add("name", scene.name).add("look_at", scene.look_at);
  write_values(out, scene);
  for (const Material& m : scene.materials) write_material(out, m);
  write_solids(out, scene.solids);
  write_bodies(out, scene, folder);
  write_view(out, scene);
  if (out.text().size() > max_toml_file_size) throw SceneError("the scene has too many bodies for a scene file");
  try {
    static_cast<void>(toml::parse(out.text()));  // fails if a text is not UTF-8
  } catch (const toml::parse_error& error) {
    throw SceneError("a name in the scene cannot be written: " + std::string(error.description()));
  }
  return out.text();
}

}  // namespace softbody
