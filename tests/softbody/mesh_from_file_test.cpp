// Bodies of scenes whose mesh is a file: a concave one keeps its shape when it falls.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "softbody/forces/shape_matching.h"
#include "softbody/integrate/force_stage.h"
#include "softbody/mechanics/deformation.h"
#include "softbody/mechanics/make_body_model.h"
#include "softbody/mesh/file_mesh.h"
#include "tests/softbody/helpers.h"
#include "tests/softbody/obj_lines.h"

namespace softbody::test {
namespace THIS_FILE {

/// A ring of quads: closed, concave, with a hole.
std::string torus(int around, int across) {
  std::string text;
  constexpr double tau = 6.283185307179586;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = tau * i / around, b = tau * j / across, r = 1 + 0.35 * std::cos(b);
      text += vertex({r * std::cos(a), 0.35 * std::sin(b), r * std::sin(a)});
    }
  const auto at = [&](int i, int j) { return i % around * across + j % across + 1; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) text += face({at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
  return text;
}

/// Returns a scene in which a ring falls on a solid sphere.
Scene ring_scene(const TemporaryFolder& folder, int around, int across) {
  folder.write("ring.obj", torus(around, across));
  return load_scene(folder.write("ring.toml", R"(
[collision]
tolerance = 0.1
[sleep]
speed = 0.05
[[solid_sphere]]
centre = [0, 1, 0]
friction = 0.25
[ground]
[[material]]
structural = {stiffness = 20, damping_ratio = 0.1}
bend = {stiffness = 5, damping_ratio = 0.1}
gas_pressure = 101_325
ambient_pressure = 101_325
internal_damping = 10
rolling_resistance = 0.3
rebound_speed = 2
[[body]]
mesh = {kind = "file", path = "ring.obj", size = 1.3}
position = [0.9, 2.6, 0.1]
)"));
}

/// Root mean square distance of the particles from the mesh's own shape, in m.
double distortion(const World& world) {
  Material m = world.model(0).material;
  m[ShapeMatching::frequency] = 1;
  const auto p = make_body_model(world.scene().bodies[0].mesh, m);
  std::vector<glm::dvec3> x;
  for (Index i = 0; i < p->mesh.vertices.size(); ++i) x.push_back(world.particle(0, i).position);
  return std::sqrt(2 * elastic_energy(only<ShapeMatching>(*p), x) /
                   (data<ShapeMatching>(*p)->stiffness * double(x.size())));
}

/// In surface contact a ring that lies on a sphere has many features on it at once.
TEST(MeshFromFile, ARingComesToRestOnASolidSphereBySurfaceContact) {
  const TemporaryFolder folder;
  Scene scene = ring_scene(folder, 18, 10);
  scene.contact_surface = ContactSurface::surfaces;
  shape_of<SolidSphere>(scene).radius = 0.8;
  scene.bodies[0].position = {0.02, 2.15, 0};
  World world(scene, {});
  run(world, 250);
  EXPECT_TRUE(world.all_at_rest()) << measure(world).max_speed << " m/s";
}

TEST(MeshFromFile, AConcaveBodyFallsComesToRestAndKeepsItsShape) {
  const TemporaryFolder folder;
  Scene scene = ring_scene(folder, 30, 12);
  World world(scene, {});
  run(world, 30);
  const double impact = distortion(world);
  for (int i = 30; i < 400; ++i) {
    world.step();
    const Measures m = measure(world);
    ASSERT_TRUE(m.finite);
    ASSERT_NEAR(m.volume_ratio_min, 1, 0.03);
    ASSERT_NEAR(m.volume_ratio_max, 1, 0.03);
    ASSERT_LT(m.deepest_penetration, 1e-5);
  }
  EXPECT_TRUE(world.all_at_rest());
  EXPECT_LT(distortion(world), 0.02) << "in 1.3 m";
  EXPECT_GT(impact, 0.001) << "it is soft";

  Material& limp = scene.materials[0];
  limp[ShapeMatching::frequency] = 0;
  for (const Key* key : {&contact::rolling_resistance, &contact::rebound_speed}) limp[*key] = key->fallback;
  World other(scene, {});
  EXPECT_FALSE(other.plan().has(stage_of<ShapeMatching>));
  run(other, 400);
  EXPECT_GT(distortion(other), 3 * distortion(world)) << "springs and gas alone do not hold it";
}

/// Returns the smallest angle of a mesh's triangles, in degrees.
double smallest_angle(const Mesh& mesh) {
  double largest_cosine = -1;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3& at = mesh.vertices[t[k]];
      largest_cosine = std::max(largest_cosine, glm::dot(glm::normalize(mesh.vertices[t[(k + 1) % 3]] - at),
                                                         glm::normalize(mesh.vertices[t[(k + 2) % 3]] - at)));
    }
  return glm::degrees(std::acos(largest_cosine));
}

TEST(MeshFromFile, ShippedMeshesAreEvenClosedAndRideOnCoarseOnes) {
  for (const char* name : {"creature", "torus-knot", "bowl"}) {
    SCOPED_TRACE(name);
    const ImportedMesh imported = import_mesh({.path = SBCOLLIDE_SCENES "/../meshes/" + std::string(name) + ".ply"});
    const ImportFindings& f = imported.findings;
    EXPECT_TRUE(f.closed);
    EXPECT_EQ(f.components, 1u);
    EXPECT_EQ(f.welded_vertices + f.unused_vertices + f.degenerate_faces + f.duplicate_faces + f.turned_faces, 0u);
    EXPECT_GT(smallest_angle(imported.mesh), 28);
    ASSERT_TRUE(imported.coarse);
    EXPECT_LT(imported.coarse->distance, 0.02 * f.extent);
    EXPECT_EQ(imported.coarse->crossings, 0u);
  }
}

TEST(MeshFromFile, IsReadOnceForAllBodiesAndFoundFromTheSceneFile) {
  const TemporaryFolder folder;
  folder.write("a.obj", tetrahedron);
  const std::string mesh = "mesh = {kind = \"file\", path = \"a.obj\"";
  const Scene scene = load_scene(folder.write(
      "s.toml", "[[body]]\n" + mesh + "}\nlattice = {size = [2, 1, 1]}\n[[body]]\n" + mesh + "}\n[[body]]\n" + mesh +
                    ", size = 2, weld = 0, up = [0, 0, 1]}\n[dropper]\n" + mesh + "}\n"));
  EXPECT_EQ(scene.bodies[0].mesh.imported, scene.bodies[2].mesh.imported);
  EXPECT_EQ(scene.bodies[0].mesh, scene.dropper->body.mesh);
  EXPECT_NE(scene.bodies[0].mesh.imported, scene.bodies[3].mesh.imported);
  EXPECT_EQ(scene.bodies[3].mesh.imported->findings.extent, 2);
  EXPECT_EQ(scene.bodies[0].mesh.vertex_count(), 4u);
}

TEST(MeshFromFile, ErrorsNameSceneAndMesh) {
  const TemporaryFolder folder;
  folder.write("bad.obj", "v 0 0 0\nv 0 0 x\n");
  folder.write("good.obj", tetrahedron);
  const auto expect_refused = [&](const std::string& toml, const std::string& words) {
    const auto file = folder.write("s.toml", "[[body]]\nmesh = {kind = \"file\"" + toml + "}\n");
    expect_error(words, [&] { load_scene(file); });
    expect_error(file.string() + ":2: mesh.", [&] { load_scene(file); });
  };
  expect_refused("", "path must name an OBJ or PLY file");
  expect_refused(", path = \"none.obj\"", "none.obj: cannot be read");
  expect_refused(", path = \".\"", "cannot be read");
  expect_refused(", path = \"bad.obj\"", "bad.obj:2: 'x' is no number");
  expect_refused(", path = \"bad.obj\", size = 0", "size must be");
  expect_refused(", path = \"bad.obj\", up = [0, 0, 0]", "up must point somewhere");
  expect_refused(", path = \"good.obj\", radius = 1", "radius");
}

}  // namespace THIS_FILE
}  // namespace softbody::test
