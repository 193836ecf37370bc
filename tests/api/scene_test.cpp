#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <set>
#include <sstream>
#include <thread>

#include <sbcollide/softbody.h>

#include "softbody/world/measures.h"
#include "tests/api/expect_error.h"
#include "tests/api/ring.h"
#include "tests/temporary_folder.h"

namespace api::test {
namespace THIS_FILE {

using sbcollide::Body;
using sbcollide::Error;
using sbcollide::Index;
using sbcollide::Scene;
using sbcollide::World;
using sbcollide::WorldSettings;

World run(const Scene& scene, int frames, const WorldSettings& settings = {}) {
  World world(scene, settings);
  while (world.frame() < frames) world.step();
  return world;
}

std::string scene_file(const std::string& key) { return SBCOLLIDE_SCENES "/" + key + ".toml"; }

// A tetrahedron of about 1 m, with one face turned inwards.
constexpr std::array<float, 12> tetrahedron{5, 0, 0, 6, 0, 0, 5, 1, 0, 5, 0, 1};
constexpr std::array<std::array<Index, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 3, 2}}};

TEST(ApiWorld, MovesAsTheLibrarysOwn) {
  for (const std::string key : {"drop", "D", "cloth", "star"}) {
    const World world = run(Scene::from_file(scene_file(key)), 40, {.threads = 2});
    softbody::World expected(softbody::find_scene(key, SBCOLLIDE_SCENES), {});
    while (expected.frame() < 40) expected.step();
    EXPECT_EQ(world.state_hash(), expected.state_hash()) << key;
    EXPECT_EQ(world.energies().total(), softbody::measure(expected).energy) << key;
    EXPECT_EQ(world.contacts().size(), expected.detection().contacts.size()) << key;
  }
}

TEST(Scene, BuiltInCodeMovesAsItsFile) {
  Scene text;
  text.add_text(R"(
gravity = [0, -5, 0]
[[material]]
name = "soft"
mass = 2
structural = {stiffness = 200}
[ground]
height = -0.5
friction = 0.6
[[solid_sphere]]
centre = [0, 0, 0]
radius = 0.5
[[solid_plane]]
point = [0, 0, -3]
normal = [0, 0, 1]
[[solid_box]]
centre = [2, 0, 0]
size = [1, 2, 1]
[[solid_capsule]]
from = [-1, 0, 0]
to = [-1, 0, 1]
radius = 0.25
[[body]]
mesh = {radius = 0.4, subdivisions = 1}
position = [0.1, 1.2, 0]
velocity = [0, -1, 0]
)");
  Scene code;
  code.set_gravity({0, -5, 0});
  code.add_material("soft", {{"mass", 2}, {"structural.stiffness", 200}});
  code.add_ground(-0.5);
  code.add_solid_sphere({0, 0, 0}, 0.5);
  code.add_solid_plane({0, 0, -3}, {0, 0, 1});
  code.add_solid_box({2, 0, 0}, {1, 2, 1});
  code.add_solid_capsule({-1, 0, 0}, {-1, 0, 1}, 0.25);
  code.add_body({.mesh = code.add_sphere_mesh(0.4, 1), .position = {0.1, 1.2, 0}, .velocity = {0, -1, 0}});
  EXPECT_EQ(run(code, 60).state_hash(), run(text, 60).state_hash());
}

TEST(Scene, TakesPresetsOfMaterials) {
  Scene scene(SBCOLLIDE_SCENES "/../materials.toml");
  scene.add_material("mine", {{"mass", 3}}, "jelly");
  scene.add_body({.mesh = scene.add_sphere_mesh(0.5), .material = "mine"});
  EXPECT_TRUE(run(scene, 1).finite());
}

TEST(Scene, KeepsTheOrderOfAMesh) {
  Scene scene;
  scene.add_body({.mesh = scene.add_mesh(tetrahedron, faces), .position = {0, 1, 0}});
  World world(scene);
  ASSERT_EQ(world.positions().x.size(), 4u);
  ASSERT_EQ(world.triangles(0).size(), 4u);
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_NEAR(world.positions().x[v], tetrahedron[3 * v] - 5.5, 0.2);
    EXPECT_NEAR(world.positions().y[v], tetrahedron[3 * v + 1] + 0.5, 0.2);
  }
  world.step();
  EXPECT_LT(world.velocities()[0][1], 0);
}

TEST(Scene, LetsAsManyParticlesSimulateAMeshAsItsFileDoes) {
  const Ring ring;
  std::ostringstream obj;
  obj << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (std::size_t i = 0; i < ring.xyz.size(); i += 3)
    obj << "v " << double{ring.xyz[i]} << ' ' << double{ring.xyz[i + 1]} << ' ' << double{ring.xyz[i + 2]} << '\n';
  for (const auto& [a, b, c] : ring.triangles) obj << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  const tests::TemporaryFolder folder;
  const std::string file = folder.write("ring.obj", obj.str()).string();
  std::set<std::uint64_t> hashes;
  for (const int resolution : {0, 200, 1800}) {
    Scene code, text;
    code.add_ground(-0.3);
    text.add_text("[ground]\nheight = -0.3\nfriction = 0.6\n[[body]]\nmesh = {kind = \"file\", path = \"" + file +
                  "\", resolution = " + std::to_string(resolution) + "}\nposition = [0, 0, 0]\n");
    code.add_body({.mesh = ring.add_to(code, resolution)});
    const World world = run(code, 20);
    EXPECT_EQ(world.state_hash(), run(text, 20).state_hash()) << resolution;
    EXPECT_EQ(world.positions().x.size(), 1800u);
    hashes.insert(world.state_hash());
  }
  EXPECT_EQ(hashes.size(), 3u);
  for (const int resolution : {-1, 49}) {
    Scene scene;
    expect_error("resolution", [&] { ring.add_to(scene, resolution); });
  }
}

TEST(ApiWorld, GivesTheVelocityOfEachVertexOfAFineMesh) {
  Scene scene;
  scene.add_ground(-0.25);
  scene.add_body({.mesh = Ring().add_to(scene), .velocity = {0, -3, 0}});
  World world(scene, {.frame_time = 0.001});
  for (int i = 0; i < 50; ++i) world.step();
  const std::vector before(world.positions().y.begin(), world.positions().y.end());
  world.step();
  const std::vector<sbcollide::Vector> velocities = world.velocities();
  ASSERT_EQ(velocities.size(), before.size());
  double slowest = INFINITY, fastest = -INFINITY, furthest_off = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    const double moved = (double{world.positions().y[v]} - before[v]) / 0.001;
    slowest = std::min(slowest, moved), fastest = std::max(fastest, moved);
    furthest_off = std::max(furthest_off, std::abs(velocities[v][1] - moved));
  }
  EXPECT_GT(fastest - slowest, 1);  // m/s: an impact
  EXPECT_LT(furthest_off, 0.1 * (fastest - slowest));
}

TEST(ApiWorld, GivesTheContactsOfTheVerticesOfFineMeshes) {
  Scene scene;
  const int ring = Ring().add_to(scene);
  scene.add_body({.mesh = ring});
  scene.add_body({.mesh = ring, .position = {0, 0.41, 0}});  // 0.01 m above
  const World world(scene);                                  // fewer than 1800 particles simulate both
  EXPECT_TRUE(std::ranges::any_of(world.contacts(), [](const sbcollide::Contact& c) { return c.b >= 1800; }));
}

TEST(Scene, RefusesMeshesThatAreNoSurface) {
  Scene scene;
  const auto add = [&scene](std::vector<float> xyz, std::vector<std::array<Index, 3>> triangles) {
    return [&scene, xyz, triangles] { scene.add_mesh(xyz, triangles); };
  };
  expect_error("triangle 0", add({0, 0, 0, 1, 0, 0, 0, 1, 0}, {{0, 1, 3}}));
  expect_error("triangle 0", add({0, 0, 0, 1, 0, 0, 0, 1, 0}, {{0, 1, 1}}));
  expect_error("vertex 3", add({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1}, {{0, 1, 2}}));
  expect_error("m large", add({0, 0, 0, 0, 0, 0, 0, 0, 0}, {{0, 1, 2}}));
  expect_error("m large", add({}, {}));
  expect_error("not finite", add({0, 0, INFINITY, 1, 0, 0, 0, 1, 0}, {{0, 1, 2}}));
  expect_error("coordinates", add({0, 0}, {}));
  expect_error("between vertices 0 and 1",
               add({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));
  expect_error("no volume", add({0, 0, 0, 1, 0, 0, 0, 1, 0}, {{0, 1, 2}, {0, 2, 1}}));
}

TEST(ApiWorld, SaysWhatIsWrong) {
  expect_error("cannot be read", [] { Scene::from_file("/nowhere.toml"); });
  const auto refused = [](const std::string& words, const auto& change, const WorldSettings& settings = {}) {
    expect_error(words, [&] {
      Scene scene;
      scene.add_sphere_mesh(0.5);
      change(scene);
      World world(scene, settings);
    });
  };
  const auto nothing = [](Scene&) {};
  refused("threads", nothing, {.threads = -1});
  refused("frame_time", nothing, {.frame_time = 0});
  refused("use one of: auto", nothing, {.integrator = "best"});
  refused("mesh 1", [](Scene& s) { s.add_body({.mesh = 1}); });
  refused("mesh -1", [](Scene& s) { s.add_body({.mesh = -1}); });
  refused("material 'gold'", [](Scene& s) { s.add_body({.material = "gold"}); });
  refused("position", [](Scene& s) { s.add_body({.position = {0, NAN, 0}}); });
  refused("velocity", [](Scene& s) { s.add_body({.velocity = {0, 2000, 0}}); });
  refused("appear", [](Scene& s) { s.add_body({.appear = -1}); });
  refused("radius", [](Scene& s) { s.add_solid_sphere({0, 0, 0}, -1); });
  refused("finite", [](Scene& s) { s.add_ground(INFINITY); });
  refused("gravity", [](Scene& s) { s.set_gravity({0, 2000, 0}); });
  refused("no key 'colour'", [](Scene& s) { s.add_material("red", {{"colour", 1}}); });
  refused("mass", [](Scene& s) { s.add_material("light", {{"mass", -1}}); });
  refused("presets", [](Scene& s) { s.add_material("soft", {}, "jelly"); });
  refused("radius", [](Scene& s) { s.add_sphere_mesh(0); });
  refused("subdivisions", [](Scene& s) { s.add_sphere_mesh(1, 7); });
  refused("scene:", [](Scene& s) { s.add_text("this is no TOML"); });
  World empty{Scene()};
  expect_error("body 0", [&] { (void)empty.first_vertex(0); });
  expect_error("body 0", [&] { (void)empty.triangles(0); });
  empty.step();
  EXPECT_EQ(empty.frame(), 1);
}

TEST(ApiWorld, TakesBodiesWhileItRuns) {
  Scene scene;
  scene.add_ground();
  const int ball = scene.add_sphere_mesh(0.5);
  scene.add_body({.mesh = ball, .position = {0, 0.5, 0}});
  World world = run(scene, 10);
  EXPECT_EQ(world.add_body({.mesh = ball, .position = {0, 1.4, 0}}), 1u);
  expect_error("mesh 1", [&] { world.add_body({.mesh = 1}); });
  for (int i = 0; i < 30; ++i) world.step();
  EXPECT_EQ(world.bodies(), 2u);
  EXPECT_EQ(world.first_vertex(1), 162u);
  EXPECT_FALSE(world.contacts().empty());
}

TEST(ApiWorld, MovesOnSeveralThreadsEachWithOneOfThem) {
  const Scene scene = Scene::from_file(scene_file("B"));
  std::vector<std::uint64_t> hashes(3);
  {
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < hashes.size(); ++t)
      threads.emplace_back([&, t] { hashes[t] = run(scene, 20, {.threads = int(t) + 1}).state_hash(); });
  }
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
}

}  // namespace THIS_FILE
}  // namespace api::test
