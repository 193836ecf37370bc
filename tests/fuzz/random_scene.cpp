#include "random_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string_view>
#include <tuple>
#include <utility>

#include "softbody/contact/keys.h"
#include "softbody/forces/gas.h"
#include "softbody/mechanics/material_keys.h"
#include "softbody/mesh/limits.h"
#include "softbody/scene/scene_keys.h"
#include "tests/solids.h"

namespace fuzz {

namespace {

using softbody::Scene;

/// Of one value: what is usual, and what a scene file may hold (softbody/scene/scene_toml.cpp).
struct Range {
  double usual_least, usual_most, least, most;
};
constexpr Range lengths{0.05, 1, 1e-9, 1e6}, sizes{0.05, 1, softbody::min_body_size, softbody::max_body_size},
    shares{0.1, 1, 0, 1}, coefficients{0.1, 1, 0, 10};

Range range_of(const softbody::Key& key) {
  constexpr std::array<std::tuple<std::string_view, double, double>, 5> usual{
      {{"kg", 0.05, 20}, {"N/m", 1, 1e5}, {"Pa", 10, 2e5}, {"m", 1e-3, 0.05}, {"", 0.01, 1}}};
  Range range{0.1, 100, key.limits.least, key.limits.most};
  for (const auto& [unit, least, most] : usual)
    if (unit == key.unit) range.usual_least = least, range.usual_most = most;
  return range;
}

/// In equal ratios.
double between(Bytes& bytes, double least, double most) {
  const int step = bytes.byte() << 8 | bytes.byte();
  return std::clamp(least * std::pow(most / least, step / 65535.0), least, most);
}

double read(Bytes& bytes, const Range& range) {
  switch (bytes.below(32)) {
    case 1:
      return range.least;
    case 2:
      return range.most;
    case 3:
      return between(bytes, std::max(range.least, 1e-9), range.most);
    default:
      return between(bytes, range.usual_least, range.usual_most);
  }
}

/// True if one is of no use without the other, as two pressures.
bool belong_together(const softbody::Key& a, const softbody::Key& b) {
  return a.unit == b.unit || (!a.table().empty() && a.table() == b.table());
}

softbody::MeshSource read_mesh(Bytes& bytes) {
  softbody::MeshSource mesh;
  if (bytes.below(4) != 0) {
    mesh.subdivisions = bytes.one_of({0, 0, 0, 1, 1, 2});
    mesh.radius = read(bytes, sizes);
    return mesh;
  }
  mesh.kind = "grid";
  mesh.columns = 1 + bytes.below(6), mesh.rows = 1 + bytes.below(6);
  mesh.width = read(bytes, sizes), mesh.depth = read(bytes, sizes);
  return mesh;
}

/// Returns a ball or a sheet, rough or smooth, round or flat; of 162 vertices on 50 particles or more, and rarely of so
/// many that 800 simulate it.
softbody::MeshSource read_fine_mesh(Bytes& bytes) {
  const auto imported = std::make_shared<softbody::ImportedMesh>();
  const bool large = bytes.below(16) == 1, ball = bytes.below(4) != 0;
  const double size = read(bytes, sizes), roughness = bytes.one_of({0.0, 0.1, 0.3}), flat = bytes.one_of({1.0, 0.1});
  softbody::Mesh& mesh = imported->mesh;
  mesh = ball ? softbody::icosphere(large ? 4 : 2, 1) : softbody::quad_grid(large ? 32 : 12, large ? 32 : 12, 1, 1);
  std::mt19937 random = bytes.random();
  for (glm::dvec3& v : mesh.vertices) {
    const double more = roughness * random() / std::mt19937::max();
    v = size * glm::dvec3(1, flat, 1) * (ball ? (1 + more) * v : v + glm::dvec3(0, more, 0));
  }
  softbody::connect_triangles(mesh);
  softbody::add_coarse_mesh(*imported, large ? 0 : bytes.one_of({50u, 60u, 100u, 150u}));
  imported->findings.closed = mesh.closed;
  return {.kind = "file", .imported = imported};
}

glm::dvec3 read_place(Bytes& bytes) {
  switch (bytes.below(32)) {
    case 1:
      return read_vector(bytes, 1e6);
    case 2:
      return glm::dvec3(0.0);
    default:
      return read_vector(bytes, 1.5);
  }
}

softbody::Solid::Shape read_shape(Bytes& bytes) {
  switch (bytes.below(5)) {
    case 0: {
      softbody::SolidSphere s;
      s.centre = read_place(bytes), s.radius = read(bytes, lengths);
      return s;
    }
    case 1: {
      softbody::SolidPlane p;
      const glm::dvec3 normal = read_vector(bytes, 1);
      p.point = read_place(bytes);
      if (glm::length(normal) > 0.01) p.normal = glm::normalize(normal);
      return p;
    }
    case 2: {
      softbody::SolidBox b;
      b.centre = read_place(bytes);
      for (int axis = 0; axis < 3; ++axis) b.half_size[axis] = 0.5 * read(bytes, lengths);
      const glm::dvec3 x = read_vector(bytes, 1), y = glm::cross(read_vector(bytes, 1), x);
      if (glm::length(y) > 0.01)
        b.axes = glm::dmat3(glm::normalize(x), glm::normalize(y), glm::normalize(glm::cross(x, y)));
      return b;
    }
    case 3: {
      softbody::SolidCapsule c;
      c.from = read_place(bytes), c.to = read_place(bytes), c.radius = read(bytes, lengths);
      return c;
    }
    default:
      return softbody::Ground{read_place(bytes).y};
  }
}

void read_solid(Bytes& bytes, Scene& scene) {
  softbody::Solid solid{read_shape(bytes)};
  solid.friction = read(bytes, coefficients);
  solid.restitution = bytes.below(2) == 0 ? 0 : read(bytes, shares);
  solid.traits().single ? tests::set_solid(scene, solid) : tests::add_solid(scene, solid);
}

void read_collision(Bytes& bytes, Scene& scene) {
  scene.method =
      collide::method_table()[static_cast<std::size_t>(bytes.below(int(collide::method_table().size())))].key;
  scene.contact_surface = bytes.below(2) == 0 ? softbody::ContactSurface::vertices : softbody::ContactSurface::surfaces;
  collide::Settings& c = scene.collision;
  c.tolerance = static_cast<float>(read(bytes, {0.01, 0.2, softbody::min_length, softbody::max_tolerance}));
  c.self_collision = bytes.below(2) == 0;
  c.levels = bytes.one_of({3, 0, 6, collide::max_levels});
  c.buckets = bytes.one_of({1001u, 101u, 1u, 65536u});
  if (bytes.below(4) != 0) return;
  c.cell_size.emplace();
  for (int axis = 0; axis < 3; ++axis)
    (*c.cell_size)[axis] = static_cast<float>(read(bytes, {0.1, 1, softbody::min_length, softbody::max_length}));
}

}  // namespace

glm::dvec3 read_vector(Bytes& bytes, double size) {
  const double x = bytes.fraction(), y = bytes.fraction(), z = bytes.fraction();
  return size * glm::dvec3(x, y, z);
}

softbody::Material read_material(Bytes& bytes, const std::string& name) {
  softbody::Material m;
  m.name = name;
  const softbody::Key* before = nullptr;  // if that one may be left out
  bool there = true;
  for (const softbody::Key* key : softbody::material_keys()) {
    if (key->options.is_switch) {
      m[*key] = bytes.below(2) == 0;
      continue;
    }
    const bool optional = !(key->fallback > 0);
    const bool often = key == &softbody::GasPressure::inside || key == &softbody::contact::restitution;
    if (!optional || !before || !belong_together(*before, *key)) there = !optional || bytes.below(often ? 2 : 4) == 0;
    if (there) m[*key] = read(bytes, range_of(*key));
    before = optional ? key : nullptr;
  }
  return m;
}

/// Reads all of it but its mesh.
softbody::BodySource read_body_of(softbody::MeshSource mesh, Bytes& bytes, int materials) {
  softbody::BodySource body;
  body.mesh = std::move(mesh);
  body.material = bytes.below(materials);
  body.position = read_place(bytes);
  body.velocity = read_vector(bytes, bytes.one_of({0.0, 1.0, 10.0, 100.0, 1000.0}));
  return body;
}

softbody::BodySource read_body(Bytes& bytes, int materials) { return read_body_of(read_mesh(bytes), bytes, materials); }

softbody::BodySource read_fine_body(Bytes& bytes, int materials) {
  return read_body_of(read_fine_mesh(bytes), bytes, materials);
}

softbody::Scene read_scene(Bytes& bytes, const std::string& key) {
  Scene scene;
  scene.key = scene.name = key;
  if (bytes.below(4) == 0) scene.gravity = read_vector(bytes, bytes.one_of({10.0, 0.0, 1e2, softbody::max_gravity}));
  read_collision(bytes, scene);
  for (const char* name : {"a", "b"}) scene.materials.push_back(read_material(bytes, name));
  const int bodies = 1 + bytes.below(4), solids = bytes.below(3);
  for (int k = 0; k < bodies; ++k) {
    softbody::BodySource& body = scene.bodies.emplace_back(read_body(bytes, int(scene.materials.size())));
    body.appear = bytes.below(8) == 0 ? bytes.below(4) : 0;
    body.release = body.appear + (bytes.below(8) == 0 ? bytes.below(4) : 0);
  }
  for (int k = 0; k < solids; ++k) read_solid(bytes, scene);
  if (bytes.below(8) == 0) scene.sleep = {read(bytes, {1e-3, 1, 0, 1e3}), 1 + bytes.below(8)};
  return scene;
}

}  // namespace fuzz
