// The public interface: a scene is kept as the text of a scene file, and the bodies apart, so that the reader of scene
// files checks all of it.

#include <cmath>
#include <fstream>
#include <iterator>

#include <glm/common.hpp>

#include "collide/api/guarded.h"
#include "softbody/api/scene_impl.h"
#include "softbody/mechanics/material_keys.h"
#include "softbody/mesh/limits.h"
#include "softbody/mesh/surface.h"
#include "softbody/scene/scene_keys.h"
#include "softbody/scene/solid_toml.h"

namespace sbcollide {
namespace {

glm::dvec3 to_glm(const Vector& v) { return {v[0], v[1], v[2]}; }

// Throw Error unless all numbers are finite.
void require_finite(double value) {
  if (!std::isfinite(value)) throw Error("a number is not finite");
}
void require_finite(const glm::dvec3& v) {
  for (int axis = 0; axis < 3; ++axis) require_finite(v[axis]);
}
void require_finite(const glm::dmat3& m) {
  for (int axis = 0; axis < 3; ++axis) require_finite(m[axis]);
}

/// Returns a solid as a scene file has it. Throws Error unless all numbers are finite.
std::string text_of(const softbody::Solid::Shape& shape, double friction) {
  softbody::Solid solid{shape, friction};
  require_finite(friction);
  solid.values([](const char*, auto value) { require_finite(value.value); });
  softbody::TomlLines lines;
  softbody::write_solids(lines, {solid});
  return lines.text();
}

const softbody::Key& material_key(const std::string& name) {
  for (const softbody::Key* key : softbody::material_keys())
    if (key->name == name) return *key;
  throw Error("material: has no key '" + name + "'");
}

/// Sets the vertices, around the middle of their bounding box, and its largest side. Throws Error unless they can be
/// those of a body.
void place(softbody::ImportedMesh& imported, std::span<const float> xyz) {
  if (xyz.size() % 3 != 0 || xyz.size() > 3 * softbody::max_imported_vertices)
    throw Error("mesh: " + std::to_string(xyz.size()) + " coordinates; give three for each of at most " +
                std::to_string(softbody::max_imported_vertices) + " vertices");
  std::vector<glm::dvec3>& vertices = imported.mesh.vertices;
  glm::dvec3 lo(INFINITY), hi(-INFINITY);
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    const glm::dvec3 v(xyz[i], xyz[i + 1], xyz[i + 2]);
    require_finite(v);
    lo = glm::min(lo, v), hi = glm::max(hi, v);
    vertices.push_back(v);
  }
  const double extent = vertices.empty() ? 0 : std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z});
  if (extent < softbody::min_body_size || extent > softbody::max_body_size)
    throw Error("mesh: is " + std::to_string(extent) + " m large; 0.001 to 10000 m are allowed");
  for (glm::dvec3& v : vertices) v -= 0.5 * (lo + hi);
  imported.findings.extent = extent;
}

/// Throws Error unless the triangles have three corners each, all of them vertices, and leave none out.
void check_corners(std::span<const std::array<Index, 3>> triangles, std::size_t vertices) {
  std::vector<char> used(vertices, false);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (std::max({a, b, c}) >= vertices || a == b || b == c || c == a)
      throw Error("mesh: triangle " + std::to_string(t) + " must name three different vertices of the mesh");
    used[a] = used[b] = used[c] = true;
  }
  for (std::size_t v = 0; v < vertices; ++v)
    if (!used[v]) throw Error("mesh: vertex " + std::to_string(v) + " is in no triangle; leave it out");
}

softbody::MeshSource mesh_source(std::span<const float> xyz, std::span<const std::array<Index, 3>> triangles,
                                 int resolution) {
  if (resolution < 0 || (resolution > 0 && std::size_t(resolution) < softbody::min_resolution))
    throw Error("resolution: must be 0 (automatic) or at least " + std::to_string(softbody::min_resolution));
  auto imported = std::make_shared<softbody::ImportedMesh>();
  softbody::Mesh& mesh = imported->mesh;
  place(*imported, xyz);
  check_corners(triangles, mesh.vertices.size());
  mesh.triangles.assign(triangles.begin(), triangles.end());
  try {
    imported->findings.closed = softbody::orient(mesh.triangles, mesh.vertices).closed;
  } catch (const softbody::SurfaceError& error) {
    throw Error("mesh: " +
                std::string(error.triangles.size() == 2 ? "the surface "
                                                        : "the edge between vertices " + std::to_string(error.edge[0]) +
                                                              " and " + std::to_string(error.edge[1]) + " ") +
                error.what());
  }
  const double extent = imported->findings.extent;
  if (imported->findings.closed && softbody::volume(mesh.vertices, mesh.triangles) < 1e-9 * extent * extent * extent)
    throw Error("mesh: is closed but holds no volume");
  softbody::connect_triangles(mesh);
  softbody::add_coarse_mesh(*imported, std::size_t(resolution));
  return {.kind = "file", .file = {}, .imported = std::move(imported)};
}

}  // namespace

Scene::Scene(const std::filesystem::path& materials) : impl_(std::make_unique<Impl>()) { impl_->materials = materials; }
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

Scene Scene::from_file(const std::filesystem::path& file) {
  return translated([&] {
    Scene scene(softbody::presets_path(std::filesystem::absolute(file).parent_path()));
    scene.impl_->file = file;
    std::ifstream in(file);
    scene.impl_->text.assign(std::istreambuf_iterator<char>(in), {});
    if (!in || scene.impl_->text.empty()) throw Error(file.string() + ": cannot be read");
    return scene;
  });
}

void Scene::add_text(std::string_view toml) { impl_->text.append("\n").append(toml).append("\n"); }

void Scene::set_gravity(const Vector& gravity) {
  require_finite(to_glm(gravity));
  for (const double g : gravity)
    if (std::abs(g) > softbody::max_gravity) throw Error("gravity: must be from -1000 to 1000 m/s^2 along each axis");
  impl_->gravity = to_glm(gravity);
}

void Scene::add_material(std::string_view name, const std::map<std::string, double>& values, std::string_view preset) {
  softbody::TomlLines lines;
  lines.heading("[[material]]").add("name", name);
  if (!preset.empty()) lines.add("preset", preset);
  for (const auto& [key, value] : values) {
    require_finite(value);
    if (material_key(key).options.is_switch)
      lines.add(key, value != 0);
    else
      lines.add(key, value);
  }
  add_text(lines.text());
}

void Scene::add_ground(double height, double friction) { add_text(text_of(softbody::Ground{height}, friction)); }

void Scene::add_solid_plane(const Vector& point, const Vector& normal, double friction) {
  add_text(text_of(softbody::SolidPlane{to_glm(point), to_glm(normal)}, friction));
}

void Scene::add_solid_sphere(const Vector& centre, double radius, double friction) {
  add_text(text_of(softbody::SolidSphere{to_glm(centre), radius}, friction));
}

void Scene::add_solid_box(const Vector& centre, const Vector& size, double friction) {
  add_text(text_of(softbody::SolidBox{to_glm(centre), 0.5 * to_glm(size)}, friction));
}

void Scene::add_solid_capsule(const Vector& from, const Vector& to, double radius, double friction) {
  add_text(text_of(softbody::SolidCapsule{to_glm(from), to_glm(to), radius}, friction));
}

int Scene::add_mesh(std::span<const float> xyz, std::span<const std::array<Index, 3>> triangles, int resolution) {
  return translated([&] {
    impl_->meshes.push_back(mesh_source(xyz, triangles, resolution));
    return static_cast<int>(impl_->meshes.size()) - 1;
  });
}

int Scene::add_sphere_mesh(double radius, int subdivisions) {
  constexpr int most = 6;
  if (!(2 * radius >= softbody::min_body_size && radius <= softbody::max_body_size))
    throw Error("radius: must be from 0.0005 to 10000 m");
  if (subdivisions < 0 || subdivisions > most) throw Error("subdivisions: must be from 0 to 6");
  impl_->meshes.push_back({.kind = "icosphere", .subdivisions = subdivisions, .radius = radius});
  return static_cast<int>(impl_->meshes.size()) - 1;
}

void Scene::add_body(const Body& body) { impl_->bodies.push_back(body); }

softbody::Scene Scene::Impl::make() const {
  softbody::Scene scene = softbody::parse_scene(text, file, materials);
  if (gravity) scene.gravity = *gravity;
  std::uint64_t particles = 0;
  for (const softbody::BodySource& body : scene.bodies) particles += body.mesh.vertex_count();
  for (const Body& body : bodies) {
    scene.bodies.push_back(body_source(body, meshes, scene.materials));
    particles += scene.bodies.back().mesh.vertex_count();
  }
  if (particles > softbody::max_particles)
    throw Error("the scene has " + std::to_string(particles) + " particles; at most " +
                std::to_string(softbody::max_particles) + " are allowed");
  return scene;
}

softbody::BodySource body_source(const Body& body, const std::vector<softbody::MeshSource>& meshes,
                                 const std::vector<softbody::Material>& materials) {
  if (body.mesh < 0 || std::size_t(body.mesh) >= meshes.size())
    throw Error("mesh " + std::to_string(body.mesh) + ": the scene has none of this number");
  std::size_t material = 0;
  while (!body.material.empty() && material < materials.size() && materials[material].name != body.material) ++material;
  if (material == materials.size()) throw Error("material '" + body.material + "': the scene has none of this name");
  for (const double x : body.position)
    if (!(std::abs(x) <= 1e6)) throw Error("position: must be from -1000000 to 1000000 m along each axis");
  for (const double v : body.velocity)
    if (!(std::abs(v) <= 1e3)) throw Error("velocity: must be from -1000 to 1000 m/s along each axis");
  if (body.appear < 0) throw Error("appear: must not be negative");
  return {.mesh = meshes[std::size_t(body.mesh)],
          .material = static_cast<int>(material),
          .position = to_glm(body.position),
          .velocity = to_glm(body.velocity),
          .appear = body.appear,
          .release = body.appear};
}

}  // namespace sbcollide
