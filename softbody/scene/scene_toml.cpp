// Reads scene files. Each key that is read here is written in scene_write.cpp.

#include <algorithm>
#include <map>
#include <span>
#include <type_traits>

#include <glm/geometric.hpp>

#include "softbody/mechanics/material_keys.h"
#include "softbody/mesh/file_mesh.h"
#include "softbody/mesh/limits.h"
#include "softbody/scene/scene_keys.h"
#include "softbody/scene/solid_toml.h"
#include "softbody/scene/toml_table.h"

namespace softbody {
namespace {

constexpr int forever = 1'000'000'000;  // frames
constexpr double max_speed = 1e3;       // m/s

/// Reads the value of a key, if the table has it.
template <class Value>
void read(Table& t, const std::string& name, const Key& key, Value& value) {
  const auto [least, most] = key.limits;
  if constexpr (std::is_same_v<Value, bool>) {
    value = t.boolean(name, value);
  } else if constexpr (std::is_integral_v<Value>) {
    value = Value(t.integer(name, int(value), int(least), int(most)));
  } else if constexpr (std::is_floating_point_v<Value>) {
    value = Value(key.options.is_switch ? t.boolean(name, value != 0) : t.number(name, value, least, most));
  } else if constexpr (std::is_same_v<Value, glm::dvec3>) {
    value = t.vector(name, value, least, most);
  } else if constexpr (std::is_same_v<Value, std::optional<glm::vec3>>) {
    if (t.has(name)) value = glm::vec3(t.vector(name, {}, least, most));
  } else if constexpr (std::is_same_v<Value, std::array<std::uint32_t, 3>>) {
    const glm::dvec3 v = t.whole_vector(name, {value[0], value[1], value[2]}, least, most);
    value = {std::uint32_t(v.x), std::uint32_t(v.y), std::uint32_t(v.z)};
  } else if constexpr (std::is_same_v<Value, ContactSurface>) {
    const auto* found = t.has(name) ? find_contact_surface(t.text(name, "")) : &contact_surfaces[std::size_t(value)];
    if (!found) t.fail(name, "must be one of: " + contact_surface_keys());
    value = found->value;
  } else {
    value = t.text(name, value);
    if (!collide::find_driver(value)) t.fail(name, "must be one of: " + collide::method_keys());
  }
}

/// Reads values, each from the table in `root` that its key names.
class ValueReader {
 public:
  explicit ValueReader(Table& root) : root_(root) {}
  void operator()(const Key& key, auto& value) {
    const std::string inside(key.table());
    Table& t = inside.empty() ? root_ : tables_.try_emplace(inside, root_.child(inside)).first->second;
    read(t, std::string(key.own_name()), key, value);
  }
  /// Throws SceneError if one of these tables has a key that was not read.
  void close() const {
    for (const auto& [name, table] : tables_) table.close();
  }

 private:
  Table& root_;
  std::map<std::string, Table> tables_;
};

/// Reads a material. `m` holds the values for keys that the table does not have.
Material read_material(Table& table, Material m = {}) {
  m.name = table.text("name", m.name);
  ValueReader read_value(table);
  for (const Key* key : material_keys()) read_value(*key, m[*key]);
  read_value.close();
  table.close();
  return m;
}

/// Returns the known mesh of the same file and settings, or imports it. Each is read once, however many bodies use it.
MeshSource read_mesh_file(Table& table, std::vector<MeshSource>& known) {
  MeshFile file;
  file.path = table.folder() / table.text("path", "");
  file.size = table.number("size", file.size, min_body_size, max_body_size);
  file.weld = table.number("weld", file.weld, 0, 0.1);
  file.up = table.vector("up", file.up, -1, 1);
  const int most = static_cast<int>(max_imported_vertices);
  file.resolution = static_cast<std::size_t>(table.integer("resolution", 0, 0, most));
  if (file.resolution > 0 && file.resolution < min_resolution)
    table.fail("resolution", "must be 0 (automatic) or at least " + std::to_string(min_resolution));
  if (glm::length(file.up) < 0.1) table.fail("up", "must point somewhere, e.g. [0, 0, 1]");
  if (table.text("path", "").empty()) table.fail("path", "must name an OBJ or PLY file, relative to this one");
  for (const MeshSource& m : known)
    if (m.file == file) return m;
  try {
    return known.emplace_back(MeshSource::from_file(file));
  } catch (const MeshFileError& error) {
    table.fail("path", std::string("cannot be used: ") + error.what());
  }
}

/// files: the meshes read from files so far.
MeshSource read_mesh(Table table, std::vector<MeshSource>& files) {
  MeshSource m;
  m.kind = table.text("kind", m.kind);
  if (m.kind == "icosphere") {
    m.subdivisions = table.integer("subdivisions", m.subdivisions, 0, 6);
    m.radius = table.number("radius", m.radius, min_body_size, max_body_size);
  } else if (m.kind == "grid") {
    m.columns = table.integer("columns", m.columns, 1, 1000);
    m.rows = table.integer("rows", m.rows, 1, 1000);
    m.width = table.number("width", m.width, min_body_size, max_body_size);
    m.depth = table.number("depth", m.depth, min_body_size, max_body_size);
  } else if (m.kind == "file") {
    m = read_mesh_file(table, files);
  } else {
    table.fail("kind", "must be \"icosphere\", \"grid\" or \"file\"");
  }
  table.close();
  return m;
}

Spin read_spin(Table table) {
  constexpr double most = 36'000;
  const Spin s{read_direction(table, "axis", Spin().axis), table.number("degrees_per_second", 0, -most, most)};
  table.close();
  return s;
}

/// appear: the first frame of the body.
Hold read_hold(Table& table, int appear) {
  Hold h;
  if (int(table.has("box")) + int(table.has("sphere")) + int(table.has("vertices")) != 1)
    table.fail("box", "or sphere must say where, or vertices which: one of them");
  if (table.has("box")) h.where = read_shape(table.child("box"), SolidBox());
  if (table.has("sphere")) h.where = read_shape(table.child("sphere"), SolidSphere());
  if (table.has("vertices")) h.vertices = table.indices("vertices");
  h.from = table.integer("from", 0, 0, forever - 1);
  if (table.has("until")) h.until = table.integer("until", 0, std::max(appear, h.from) + 1, forever);
  h.velocity = table.vector("velocity", h.velocity, -max_speed, max_speed);
  if (!table.has("turn")) return table.close(), h;
  Table turn = table.child("turn");
  h.through = turn.vector("through", h.through, -1e6, 1e6);
  h.turn = read_spin(std::move(turn));
  table.close();
  return h;
}

/// Reads the keys that bodies and the dropper have in common.
BodySource read_body(Table& table, const std::vector<Material>& materials, std::vector<MeshSource>& files) {
  BodySource b;
  b.mesh = read_mesh(table.child("mesh"), files);
  const std::string name = table.text("material", materials.front().name);
  while (std::size_t(b.material) < materials.size() && materials[std::size_t(b.material)].name != name) ++b.material;
  if (std::size_t(b.material) == materials.size()) table.fail("material", "names no [[material]] of this file");
  b.position = table.vector("position", b.position, -1e6, 1e6);
  if (table.has("rotation")) b.axes = read_rotation(table.child("rotation"));
  b.velocity = table.vector("velocity", b.velocity, -max_speed, max_speed);
  b.spin = read_spin(table.child("spin"));
  return b;
}

/// Adds `number` copies of the body in layers upwards; the body's position is the centre of the bottom layer. Adds one
/// body if the table is empty. particles: the number of particles of the scene so far, checked before any allocation.
void add_lattice(const Table& owner, Table table, const BodySource& body, std::vector<BodySource>& bodies,
                 std::uint64_t& particles) {
  const glm::dvec3 size = table.whole_vector("size", glm::dvec3(1.0), 1, 1000);
  const glm::dvec3 spacing = table.vector("spacing", glm::dvec3(1.1), 0, 1e6);
  const double jitter = table.number("jitter", 0, 0, 1e6);
  const int nx = int(size.x), ny = int(size.y), nz = int(size.z);
  const int number = table.integer("number", nx * ny * nz, 1, nx * ny * nz);
  table.close();
  particles += std::uint64_t(number) * body.mesh.vertex_count();
  if (particles > max_particles)
    owner.fail("lattice", "brings the scene to " + std::to_string(particles) + " particles; at most " +
                              std::to_string(max_particles) + " are allowed: use fewer bodies or coarser meshes");
  std::uint64_t state = 1;
  const auto random = [&state] {  // splitmix64, the same on every platform, to [-1, 1)
    std::uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return double(std::int64_t(z ^ (z >> 31))) * 0x1p-63;
  };
  for (int i = 0; i < number; ++i) {
    const glm::dvec3 cell(i % nx - (nx - 1) / 2.0, double(i / (nx * nz)), i / nx % nz - (nz - 1) / 2.0);
    BodySource copy = body;
    copy.position += cell * spacing;
    for (int k = 0; k < 3; ++k) copy.position[k] += jitter * random();
    bodies.push_back(copy);
  }
}

/// Returns the material that the key `preset` names; one with the default values if the table has no such key.
Material read_preset(Table& table, std::span<const Material> presets) {
  if (!table.has("preset")) return {};
  const std::string name = table.text("preset", "");
  if (presets.empty()) table.fail("preset", "cannot be used here: there are no presets");
  std::string known;
  for (const Material& m : presets) {
    if (m.name == name) return m;
    known.append(known.empty() ? "" : ", ").append(m.name);
  }
  table.fail("preset", "must be one of: " + known);
}

std::vector<Material> read_materials(Table& root, const std::filesystem::path& presets) {
  std::vector<Material> materials, known;
  for (Table& t : root.children("material")) {
    if (known.empty() && !presets.empty() && t.has("preset")) known = load_presets(presets);
    Material m = read_material(t, read_preset(t, known));
    if (std::ranges::count(materials, m.name, &Material::name) > 0)
      t.fail("name", "'" + m.name + "' is that of an earlier [[material]]; give each its own");
    materials.push_back(std::move(m));
  }
  return materials;
}

void read_bodies(Table& root, Scene& scene, const std::filesystem::path& presets) {
  scene.materials = read_materials(root, presets);
  if (scene.materials.empty()) scene.materials.emplace_back();
  std::uint64_t particles = 0;
  std::vector<MeshSource> files;
  for (Table& t : root.children("body")) {
    BodySource b = read_body(t, scene.materials, files);
    b.appear = t.integer("appear", 0, 0, forever);
    b.release = t.integer("release", b.appear, 0, forever);
    if (b.release < b.appear) t.fail("release", "must not come before appear");
    for (Table& hold : t.children("hold")) b.holds.push_back(read_hold(hold, b.appear));
    add_lattice(t, t.child("lattice"), b, scene.bodies, particles);
    t.close();
  }
  if (!root.has("dropper")) return;
  Table t = root.child("dropper");
  scene.dropper.emplace();
  scene.dropper->body = read_body(t, scene.materials, files);
  scene.dropper->spread = t.number("spread", scene.dropper->spread, 0, 1e6);
  t.close();
}

void read_view(Table& root, Scene& scene) {
  Table t = root.child("view");
  scene.view.target = t.vector("target", scene.view.target, -1e6, 1e6);
  scene.view.distance = t.number("distance", scene.view.distance, 1e-9, 1e6);
  scene.view.azimuth = t.number("azimuth", scene.view.azimuth, -360, 360);
  scene.view.elevation = t.number("elevation", scene.view.elevation, -89, 89);
  t.close();
  for (Table& c : root.children("caption")) {
    scene.captions.push_back({c.integer("frame", 0, 0, 1'000'000'000), c.text("text", "")});
    c.close();
  }
}

Scene read_scene(Table root, const std::filesystem::path& file, const std::filesystem::path& presets) {
  Scene scene;
  scene.key = file.stem().string();
  scene.name = root.text("name", scene.key);
  scene.look_at = root.text("look_at", "");
  ValueReader read_value(root);
  for_each_value(scene, read_value);
  read_value.close();
  scene.solids = read_solids(root);
  read_bodies(root, scene, presets);
  read_view(root, scene);
  root.close();
  return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& file, const std::filesystem::path& presets) {
  const toml::table table = read_toml(file);
  Scene scene = read_scene(Table(table, file.string(), ""), file, presets);
  if (scene.bodies.empty() && !scene.dropper)
    throw SceneError(file.string() + ": has no body; add a [[body]] or a [dropper]");
  return scene;
}

Scene parse_scene(std::string_view text, const std::filesystem::path& file, const std::filesystem::path& presets) {
  const toml::table table = parse_toml(text, file.string());
  return read_scene(Table(table, file.string(), ""), file, presets);
}

std::vector<Material> load_presets(const std::filesystem::path& file) {
  const toml::table table = read_toml(file);
  Table root(table, file.string(), "");
  std::vector<Material> presets = read_materials(root, {});
  root.close();
  return presets;
}

}  // namespace softbody
