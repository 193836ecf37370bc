// Scene files that are in order: every key, every default.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

Scene read(const std::string& toml) {
  const TemporaryFolder folder;
  return load_scene(folder.write("some-scene.toml", toml));
}

void expect_equal(const Scene& found, const Scene& expected) {
  EXPECT_EQ(scene_toml(found, "/"), scene_toml(expected, "/"));  // shows where
  EXPECT_TRUE(found == expected);
}

TEST(SceneFile, NeedsNoMoreThanABody) {
  Scene expected;
  expected.key = expected.name = "some-scene";
  expected.materials.resize(1);
  expected.bodies.resize(1);
  expect_equal(read("[[body]]\n"), expected);
  EXPECT_EQ(expected.gravity, glm::dvec3(0, -9.81, 0));
  EXPECT_EQ(expected.bodies[0].position, glm::dvec3(0, 3, 0));
  EXPECT_TRUE(read("[dropper]\n").bodies.empty()) << "a dropper alone is enough";
}

/// Every table; the keys of materials are those of a list, of which some stand here.
constexpr const char* everything = R"(
name = "All of it"
look_at = "Every key at once."
gravity = [0.5, -1.62, 0]

[collision]
method = "grid-hash"
contact_surface = "surface"
tolerance = 0.2
self_collision = false
levels = 6
buckets = 997
cell_size = [0.5, 0.6, 0.7]
primes = [1, 4_294_967_295, 83492791]

[[material]]
name = "first"

[[material]]
name = "second"
mass = 2.5
structural = {stiffness = 400, damping_ratio = 0.25}
gas_pressure = 120_000
start_in_equilibrium = false

[[solid_sphere]]
centre = [1, 2, 3]
radius = 0.75
friction = 0.45

restitution = 0.5

[[solid_sphere]]

[[solid_plane]]
point = [0, -1, 0]
normal = [3, 4, 0]
friction = 0.15
restitution = 0.25

[[solid_box]]
centre = [5, 6, 7]
size = [2, 4, 6]
rotation = {axis = [0, 0, 2], degrees = 90}
friction = 0.16
restitution = 0.75
enabled = false

[[solid_capsule]]
from = [0, 1, 0]
to = [0, 2, 0]
radius = 0.125
friction = 0.17
restitution = 1

[ground]
height = -0.5
friction = 0.65
restitution = 0.125

[[body]]
material = "second"
mesh = {kind = "grid", columns = 7, rows = 9, width = 1.5, depth = 2.5}
position = [4, 5, 6]
velocity = [-1, 0, 1]
appear = 12
release = 34

[[body]]
mesh = {kind = "icosphere", subdivisions = 3, radius = 0.25}
appear = 5

[dropper]
material = "second"
position = [0, 9, 0]
velocity = [0, -2, 0]
spread = 0.6

[sleep]
speed = 0.04
frames = 45

[view]
target = [1, 2, 3]
distance = 12
azimuth = -45
elevation = 60

[[caption]]
frame = 10
text = "first"

[[caption]]
frame = 20
text = "second"
)";

TEST(SceneFile, ValuesArriveWhereTheyBelong) {
  Material second;
  second.name = "second";
  second[Material::mass] = 2.5;
  second.set(StructuralSprings::keys, {400, 0.25});
  second[GasPressure::inside] = 120000;
  second[Material::start_in_equilibrium] = false;
  Scene expected;
  expected.key = "some-scene";
  expected.name = "All of it";
  expected.look_at = "Every key at once.";
  expected.gravity = {0.5, -1.62, 0};
  expected.method = "grid-hash";
  expected.contact_surface = ContactSurface::surfaces;
  expected.collision = {.tolerance = 0.2f,
                        .self_collision = false,
                        .levels = 6,
                        .buckets = 997,
                        .cell_size = glm::vec3(0.5f, 0.6f, 0.7f),
                        .primes = {1, 4294967295, 83492791}};
  expected.materials.emplace_back().name = "first";
  expected.materials.push_back(second);
  const glm::dmat3 quarter_turn(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));  // which is exact
  expected.solids = {{SolidSphere{.centre = {1, 2, 3}, .radius = 0.75}, 0.45, 0.5},
                     {SolidSphere()},  // what the file does not say
                     {Ground{-0.5}, 0.65, 0.125},
                     {SolidPlane{.point = {0, -1, 0}, .normal = glm::normalize(glm::dvec3(3, 4, 0))}, 0.15, 0.25},
                     {SolidBox{.centre = {5, 6, 7}, .half_size = {1, 2, 3}, .axes = quarter_turn}, 0.16, 0.75, false},
                     {SolidCapsule{.from = {0, 1, 0}, .to = {0, 2, 0}, .radius = 0.125}, 0.17, 1}};
  expected.bodies = {{.mesh = {.kind = "grid", .columns = 7, .rows = 9, .width = 1.5, .depth = 2.5},
                      .material = 1,
                      .position = {4, 5, 6},
                      .velocity = {-1, 0, 1},
                      .appear = 12,
                      .release = 34},
                     {.mesh = {.kind = "icosphere", .subdivisions = 3, .radius = 0.25}, .appear = 5, .release = 5}};
  expected.dropper = {.body = {.mesh = {}, .material = 1, .position = {0, 9, 0}, .velocity = {0, -2, 0}},
                      .spread = 0.6};
  expected.sleep = {.speed = 0.04, .frames = 45};
  expected.view = {.target = {1, 2, 3}, .distance = 12, .azimuth = -45, .elevation = 60};
  expected.captions = {{10, "first"}, {20, "second"}};
  expect_equal(read(everything), expected);
}

TEST(SceneFile, TurnsABoxAboutItsAxis) {
  const Scene s = read("[[body]]\n[[solid_box]]\nrotation = {axis = [1, 2, -2], degrees = -73.5}\n");
  const glm::dmat3& axes = shape_of<SolidBox>(s).axes;
  const glm::dvec3 axis = glm::dvec3(1, 2, -2) / 3.0;
  EXPECT_LT(glm::distance(axes * axis, axis), 1e-12) << "the axis stays";
  EXPECT_NEAR(axes[0][0] + axes[1][1] + axes[2][2], 1 + 2 * std::cos(-73.5 / 180 * std::acos(-1.0)), 1e-11);
  EXPECT_NEAR(glm::determinant(axes), 1, 1e-11);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(glm::length(axes[k]), 1, 1e-11);
  EXPECT_LT(glm::dot(glm::cross(glm::dvec3(0, 1, 0), axes[1]), axis), 0) << "the sense of the turn";
}

TEST(SceneFile, BodiesAndTheDropper) {
  const Scene s = read(everything);
  ASSERT_EQ(s.bodies.size(), 2u);
  const BodySource& grid = s.bodies[0];
  EXPECT_EQ(grid.material, 1);
  EXPECT_EQ(grid.mesh.kind, "grid");
  EXPECT_EQ(std::pair(grid.mesh.columns, grid.mesh.rows), std::pair(7, 9));
  EXPECT_EQ(std::pair(grid.mesh.width, grid.mesh.depth), std::pair(1.5, 2.5));
  EXPECT_EQ(grid.mesh.make().vertices.size(), 80u);
  EXPECT_EQ(grid.position, glm::dvec3(4, 5, 6));
  EXPECT_EQ(grid.velocity, glm::dvec3(-1, 0, 1));
  EXPECT_EQ(std::pair(grid.appear, grid.release), std::pair(12, 34));
  EXPECT_EQ(s.bodies[1].mesh.make().vertices.size(), 642u);
  EXPECT_EQ(s.bodies[1].mesh.radius, 0.25);
  EXPECT_EQ(s.bodies[1].material, 0) << "the first is the default";
  EXPECT_EQ(s.bodies[1].release, 5) << "not held";
  ASSERT_TRUE(s.dropper);
  EXPECT_EQ(s.dropper->body.material, 1);
  EXPECT_EQ(s.dropper->body.position, glm::dvec3(0, 9, 0));
  EXPECT_EQ(s.dropper->body.velocity, glm::dvec3(0, -2, 0));
  EXPECT_EQ(s.dropper->spread, 0.6);
}

TEST(SceneFile, MakesALatticeLayerByLayer) {
  const Scene s = read(
      "[[body]]\nposition = [1, 2, 3]\nvelocity = [0, 0, 7]\nlattice = {size = [2, 2, 3], spacing = [2, 3, 4], number "
      "= 8}\n"
      "[[body]]\nposition = [9, 9, 9]\n");
  ASSERT_EQ(s.bodies.size(), 9u);
  EXPECT_EQ(s.bodies[0].position, glm::dvec3(0, 2, -1));
  EXPECT_EQ(s.bodies[1].position, glm::dvec3(2, 2, -1));
  EXPECT_EQ(s.bodies[5].position, glm::dvec3(2, 2, 7));
  EXPECT_EQ(s.bodies[6].position, glm::dvec3(0, 5, -1)) << "the next layer";
  EXPECT_EQ(s.bodies[7].velocity, glm::dvec3(0, 0, 7));
  EXPECT_EQ(s.bodies[8].position, glm::dvec3(9, 9, 9));
}

TEST(SceneFile, GivesALatticeABoundedJitterThatIsAlwaysTheSame) {
  const std::string toml = "[[body]]\nlattice = {size = [5, 5, 5], spacing = [0, 0, 0], jitter = 0.25}\n";
  const Scene s = read(toml), again = read(toml);
  ASSERT_EQ(s.bodies.size(), 125u);
  const glm::dvec3 middle(0, 3, 0);
  glm::dvec3 widest(0.0), mean(0.0);
  for (std::size_t i = 0; i < 125; ++i) {
    EXPECT_EQ(s.bodies[i].position, again.bodies[i].position);
    widest = glm::max(widest, glm::abs(s.bodies[i].position - middle));
    mean += s.bodies[i].position / 125.0;
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_GT(widest[k], 0.2);
    EXPECT_LE(widest[k], 0.25);
    EXPECT_NEAR(mean[k], middle[k], 0.05);
  }
}

TEST(SceneFolder, ListsItsScenesInOrderAndFindsThemByKeyOrPath) {
  const TemporaryFolder folder;
  folder.write("b.toml", "name = \"Bee\"\n[[body]]\n");
  folder.write("a.toml", "[[body]]\n");
  folder.write("notes.txt", "no scene");
  EXPECT_EQ(scene_keys(folder.path()), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(find_scene("b", folder.path()).name, "Bee");
  EXPECT_EQ(find_scene((folder.path() / "b.toml").string(), "/nowhere").name, "Bee");
  EXPECT_TRUE(scene_keys(folder.path() / "none").empty());
}

constexpr const char* two_presets = R"(
[[material]]
name = "soft"
mass = 2
friction = 0.25
[[material]]
name = "hard"
structural = {stiffness = 900, damping_ratio = 0.2}
)";

TEST(MaterialPresets, GiveTheValuesThatASceneLeavesOut) {
  const TemporaryFolder folder;
  const auto presets = folder.write("materials.toml", two_presets);
  const Scene s = load_scene(folder.write("scene.toml", R"(
[[material]]
preset = "soft"
[[material]]
name = "mine"
preset = "soft"
mass = 3
[[body]]
material = "mine"
)"),
                             presets);
  ASSERT_EQ(s.materials.size(), 2u);
  EXPECT_EQ(s.materials[0], load_presets(presets)[0]);
  EXPECT_EQ(s.materials[1].name, "mine");
  EXPECT_EQ(s.materials[1][Material::mass], 3);
  EXPECT_EQ(s.materials[1][contact::friction], 0.25);
  EXPECT_EQ(s.bodies[0].material, 1);
}

TEST(MaterialPresets, RefuseUnknownNamesAndMissingFiles) {
  const TemporaryFolder folder;
  const auto presets = folder.write("materials.toml", two_presets);
  const auto scene = folder.write("scene.toml", "[[material]]\npreset = \"wood\"\n[[body]]\n");
  expect_error("scene.toml:2: material[0].preset must be one of: soft, hard", [&] { load_scene(scene, presets); });
  expect_error("scene.toml:2: material[0].preset cannot be used here: there are no presets",
               [&] { load_scene(scene); });
  expect_error("none.toml", [&] { load_scene(scene, folder.path() / "none.toml"); });
}

}  // namespace THIS_FILE
}  // namespace softbody::test
