// Bodies of scenes whose mesh is a file: a concave one keeps its shape when it falls.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

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

const std::string falling_ring = R"(
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
[[material]]
name = "limp"
structural = {stiffness = 20, damping_ratio = 0.1}
bend = {stiffness = 5, damping_ratio = 0.1}
gas_pressure = 101_325
ambient_pressure = 101_325
internal_damping = 10
shape_frequency = 0
[[body]]
mesh = {kind = "file", path = "meshes/ring.obj", size = 1.3}
position = [0.9, 2.6, 0.1]
)";

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

/// By surface contact a ring that lies on a sphere has many features on it at once.
TEST(MeshFromFile, ARingComesToRestOnASolidSphereBySurfaceContact) {
  for (const auto& [around, across, radius] : {std::tuple(24, 12, 1.0), std::tuple(18, 10, 0.8)}) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "meshes");
    folder.write("meshes/ring.obj", torus(around, across));
    Scene scene = load_scene(folder.write("ring.toml", falling_ring));
    scene.contact_surface = ContactSurface::surfaces;
    shape_of<SolidSphere>(scene).radius = radius;
    scene.bodies[0].position = {0.02, 1.35 + radius, 0};
    World world(scene, {});
    run(world, 250);
    EXPECT_TRUE(world.all_at_rest()) << measure(world).max_speed << " m/s";
  }
}

TEST(MeshFromFile, AConcaveBodyFallsComesToRestAndKeepsItsShape) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "meshes");
  folder.write("meshes/ring.obj", torus(30, 12));
  World world(load_scene(folder.write("ring.toml", falling_ring)), {});
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

  Scene limp = load_scene(folder.path() / "ring.toml");
  limp.bodies[0].material = 1;
  World other(std::move(limp), {});
  EXPECT_FALSE(other.plan().has(stage_of<ShapeMatching>));
  run(other, 400);
  EXPECT_GT(distortion(other), 3 * distortion(world)) << "springs and gas alone do not hold it";
}

/// Returns a sphere as an OBJ file, whose faces may be reversed.
std::string ball_obj(const Mesh& ball, bool inwards) {
  std::string text;
  for (const glm::dvec3& v : ball.vertices) text += vertex(v);
  const int count = int(ball.vertices.size());
  for (const auto& [a, b, c] : ball.triangles)
    text += face({int(a) - count, int(inwards ? c : b) - count, int(inwards ? b : c) - count});
  return text;
}

TEST(MeshFromFile, AHollowBallFallsAndStaysHollow) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "meshes");
  const Mesh outer = icosphere(2, 0.5), inner = icosphere(1, 0.3);
  folder.write("meshes/ring.obj", ball_obj(outer, false) + ball_obj(inner, true));
  Scene scene = load_scene(folder.write("hollow.toml", falling_ring));
  const double hollow = volume(outer.vertices, outer.triangles) - volume(inner.vertices, inner.triangles);
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[1].position = {0.6, 4.2, 0.2};  // falls on the first one
  for (const ContactSurface surface : {ContactSurface::vertices, ContactSurface::surfaces}) {
    scene.contact_surface = surface;
    World world(scene, {});
    EXPECT_NEAR(world.model(0).start_volume, hollow * 1.3 * 1.3 * 1.3, 0.01);
    for (int i = 0; i < 200; ++i) {
      world.step();
      const Measures m = measure(world);
      ASSERT_TRUE(m.finite);
      ASSERT_NEAR(m.volume_ratio_min, 1, 0.05);
      ASSERT_NEAR(m.volume_ratio_max, 1, 0.05);
    }
    double lowest = INFINITY;
    for (const Particle& p : particles_of(world)) lowest = std::min(lowest, p.position.y);
    EXPECT_LT(lowest, 1.5) << "it has fallen";
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
  const auto says = [&](const std::string& toml) -> std::string {
    try {
      load_scene(folder.write("s.toml", "[[body]]\nmesh = {kind = \"file\"" + toml + "}\n"));
      return "was taken";
    } catch (const SceneError& e) {
      EXPECT_EQ(std::string(e.what()).find((folder.path() / "s.toml").string() + ":2: mesh."), 0u) << e.what();
      return e.what();
    }
  };
  EXPECT_NE(says("").find("path must name an OBJ or PLY file"), std::string::npos);
  EXPECT_NE(says(", path = \"none.obj\"").find("none.obj: cannot be read"), std::string::npos);
  EXPECT_NE(says(", path = \".\"").find("cannot be read"), std::string::npos);
  EXPECT_NE(says(", path = \"bad.obj\"").find("bad.obj:2: 'x' is no number"), std::string::npos);
  EXPECT_NE(says(", path = \"bad.obj\", size = 0").find("size must be"), std::string::npos);
  EXPECT_NE(says(", path = \"bad.obj\", up = [0, 0, 0]").find("up must point somewhere"), std::string::npos);
  EXPECT_NE(says(", path = \"good.obj\", radius = 1").find("radius"), std::string::npos);
}

/// Where dozens of springs meet, they share what six would have: fans ask for no more substeps than the rest.
TEST(MeshFromFile, AFanIsNoStifferThanARegularNet) {
  std::string fan = "v 0 0.3 0\nv 0 -0.3 0\n";
  constexpr int count = 60;
  for (int i = 0; i < count; ++i) fan += vertex({std::cos(6.2831853 * i / count), 0, std::sin(6.2831853 * i / count)});
  for (int i = 0; i < count; ++i) {
    const int a = 3 + i, b = 3 + (i + 1) % count;
    fan += face({1, b, a}) + face({2, a, b});
  }
  const TemporaryFolder folder;
  const auto p = make_body_model(MeshSource::from_file({.path = folder.write("fan.obj", fan)}), spring_ball());
  EXPECT_LE(p->forces->pair_stiffness, 6 * (300 + 75) + 1e-9);
  EXPECT_EQ(p->largest_degree, count);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
