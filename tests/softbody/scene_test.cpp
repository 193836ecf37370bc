// Scene files that are in order: every key, every default.

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(SceneFile, OneBodyIsEnoughAndTheRestHasDefaults) {
  const Scene s = read("[[body]]\n");
  const Scene plain;
  EXPECT_EQ(s.key, "some-scene");
  EXPECT_EQ(s.name, "some-scene");
  EXPECT_EQ(s.gravity, glm::dvec3(0, -9.81, 0));
  EXPECT_EQ(s.method, collide::default_method);
  EXPECT_EQ(s.collision.tolerance, plain.collision.tolerance);
  EXPECT_EQ(s.collision.levels, 3);
  EXPECT_EQ(s.collision.buckets, 1001u);
  EXPECT_EQ(s.collision.primes, collide::default_primes);
  EXPECT_TRUE(s.collision.self_collision);
  EXPECT_FALSE(s.collision.cell_size);
  EXPECT_FALSE(s.dropper);
  EXPECT_TRUE(s.solids.empty() && s.captions.empty());
  ASSERT_EQ(s.materials.size(), 1u);
  ASSERT_EQ(s.bodies.size(), 1u);
  EXPECT_EQ(s.bodies[0].mesh, MeshSource());
  EXPECT_EQ(s.bodies[0].position, glm::dvec3(0, 3, 0));
  EXPECT_EQ(s.bodies[0].velocity, glm::dvec3(0.0));
  EXPECT_EQ(s.bodies[0].appear, 0);
  EXPECT_EQ(s.bodies[0].release, 0);
}

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
bend = {stiffness = 90, damping_ratio = 0.5}
shear = {stiffness = 30, damping_ratio = 0.75}
gas_pressure = 120_000
ambient_pressure = 101325
internal_damping = 7
rebound_speed = 1.5
thickness = 0.03
friction = 0.35
restitution = 0.625
rolling_resistance = 0.15
contact_stiffness = 55
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

TEST(SceneFile, EveryKeyArrivesWhereItBelongs) {
  const Scene s = read(everything);
  EXPECT_EQ(s.name, "All of it");
  EXPECT_EQ(s.look_at, "Every key at once.");
  EXPECT_EQ(s.gravity, glm::dvec3(0.5, -1.62, 0));
  EXPECT_EQ(s.method, "grid-hash");
  EXPECT_EQ(s.contact_surface, ContactSurface::surfaces);
  EXPECT_EQ(s.collision.tolerance, 0.2f);
  EXPECT_FALSE(s.collision.self_collision);
  EXPECT_EQ(s.collision.levels, 6);
  EXPECT_EQ(s.collision.buckets, 997u);
  EXPECT_TRUE(s.collision.cell_size);
  EXPECT_EQ(s.collision.cell_size, glm::vec3(0.5f, 0.6f, 0.7f));
  EXPECT_EQ(s.collision.primes, (std::array<std::uint32_t, 3>{1, 4294967295, 83492791}));
  EXPECT_EQ(s.sleep.speed, 0.04);
  EXPECT_EQ(s.sleep.frames, 45);
  EXPECT_EQ(s.view.target, glm::dvec3(1, 2, 3));
  EXPECT_EQ(s.view.distance, 12);
  EXPECT_EQ(s.view.azimuth, -45);
  EXPECT_EQ(s.view.elevation, 60);
  ASSERT_EQ(s.captions.size(), 2u);
  EXPECT_EQ(s.captions[1].frame, 20);
  EXPECT_EQ(s.captions[1].text, "second");
}

TEST(SceneFile, MaterialsAndSolids) {
  const Scene s = read(everything);
  ASSERT_EQ(s.materials.size(), 2u);
  const Material& m = s.materials[1];
  EXPECT_EQ(m.name, "second");
  EXPECT_EQ(m[Material::mass], 2.5);
  EXPECT_EQ(std::pair(m[StructuralSprings::stiffness], m[StructuralSprings::damping_ratio]), std::pair(400.0, 0.25));
  EXPECT_EQ(std::pair(m[BendSprings::stiffness], m[BendSprings::damping_ratio]), std::pair(90.0, 0.5));
  EXPECT_EQ(std::pair(m[ShearSprings::stiffness], m[ShearSprings::damping_ratio]), std::pair(30.0, 0.75));
  EXPECT_EQ(m[GasPressure::inside], 120000);
  EXPECT_EQ(m[GasPressure::outside], 101325);
  EXPECT_EQ(m[Material::internal_damping], 7);
  EXPECT_EQ(m[contact::rebound_speed], 1.5);
  EXPECT_EQ(m[Material::thickness], 0.03);
  EXPECT_EQ(m[contact::friction], 0.35);
  EXPECT_EQ(m[contact::restitution], 0.625);
  EXPECT_EQ(m[contact::rolling_resistance], 0.15);
  EXPECT_EQ(m[contact::stiffness], 55);
  EXPECT_FALSE(m[Material::start_in_equilibrium]);
  ASSERT_EQ(count_solids<SolidSphere>(s), 2);
  EXPECT_EQ(shape_of<SolidSphere>(s).centre, glm::dvec3(1, 2, 3));
  EXPECT_EQ(shape_of<SolidSphere>(s).radius, 0.75);
  EXPECT_EQ(solid_of<SolidSphere>(s).friction, 0.45);
  EXPECT_EQ(solid_of<SolidSphere>(s).restitution, 0.5);
  EXPECT_EQ(s.solids[1], Solid{SolidSphere()}) << "what the file does not say";
  EXPECT_EQ(count_solids<Ground>(s), 1);
  EXPECT_EQ(shape_of<Ground>(s).height, -0.5);
  EXPECT_EQ(solid_of<Ground>(s).friction, 0.65);
  EXPECT_EQ(solid_of<Ground>(s).restitution, 0.125);
}

TEST(SceneFile, PlanesBoxesAndCapsules) {
  const Scene s = read(everything);
  ASSERT_EQ(count_solids<SolidPlane>(s), 1);
  EXPECT_EQ(shape_of<SolidPlane>(s).point, glm::dvec3(0, -1, 0));
  EXPECT_LT(glm::distance(shape_of<SolidPlane>(s).normal, glm::dvec3(0.6, 0.8, 0)), 1e-15) << "of length 1";
  EXPECT_EQ(std::pair(solid_of<SolidPlane>(s).friction, solid_of<SolidPlane>(s).restitution), std::pair(0.15, 0.25));
  ASSERT_EQ(count_solids<SolidBox>(s), 1);
  EXPECT_EQ(shape_of<SolidBox>(s).centre, glm::dvec3(5, 6, 7));
  EXPECT_EQ(shape_of<SolidBox>(s).half_size, glm::dvec3(1, 2, 3));
  EXPECT_EQ(shape_of<SolidBox>(s).axes, glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1)))
      << "a quarter turn is exact";
  EXPECT_EQ(std::pair(solid_of<SolidBox>(s).friction, solid_of<SolidBox>(s).restitution), std::pair(0.16, 0.75));
  EXPECT_FALSE(solid_of<SolidBox>(s).enabled);
  ASSERT_EQ(count_solids<SolidCapsule>(s), 1);
  EXPECT_EQ(shape_of<SolidCapsule>(s).from, glm::dvec3(0, 1, 0));
  EXPECT_EQ(shape_of<SolidCapsule>(s).to, glm::dvec3(0, 2, 0));
  EXPECT_EQ(shape_of<SolidCapsule>(s).radius, 0.125);
  EXPECT_EQ(std::pair(solid_of<SolidCapsule>(s).friction, solid_of<SolidCapsule>(s).restitution), std::pair(0.17, 1.0));
  EXPECT_TRUE(solid_of<SolidCapsule>(s).enabled);
}

TEST(SceneFile, ABoxTurnsAboutItsAxisAndStaysOrthonormal) {
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

TEST(SceneFile, ALatticeIsCopiesOfABodyLayerByLayer) {
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

TEST(SceneFile, ALatticesJitterIsBoundedAndAlwaysTheSame) {
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

TEST(SceneFile, ADropperAloneIsEnough) { EXPECT_TRUE(read("[dropper]\n").bodies.empty()); }

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

TEST(SceneFolder, OfTheProgramLoadsWhole) {
  const auto keys = scene_keys(SBCOLLIDE_SCENES);
  EXPECT_NE(std::find(keys.begin(), keys.end(), "drop"), keys.end());
  for (const std::string& key : keys) {
    const Scene s = find_scene(key, SBCOLLIDE_SCENES);
    EXPECT_FALSE(s.name.empty()) << key;
    EXPECT_FALSE(s.look_at.empty()) << key;
  }
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
  const auto message = [&](const std::filesystem::path& file) -> std::string {
    try {
      load_scene(scene, file);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(presets).find("scene.toml:2"), std::string::npos) << message(presets);
  EXPECT_NE(message(presets).find("must be one of: soft, hard"), std::string::npos) << message(presets);
  EXPECT_NE(message(folder.path() / "none.toml").find("none.toml"), std::string::npos);
  EXPECT_NE(message({}).find("scene.toml:2"), std::string::npos) << message({});
  EXPECT_NE(message({}).find("there are no presets"), std::string::npos) << message({});
}

/// A ball of the scene drop flattens at rest, and is round before it touches anything.
TEST(MaterialPresets, JellyIsSoft) {
  Scene scene = find_scene("drop", SBCOLLIDE_SCENES);
  scene.bodies.resize(1);
  scene.bodies[0].position = {4, 1.5, 0};
  scene.bodies[0].release = 0;
  World world(scene, {});
  const auto flatness = [&] {
    const collide::Frame f = world.positions();
    const auto extent = [](std::span<const float> x) {
      const auto [lo, hi] = std::ranges::minmax_element(x);
      return *hi - *lo;
    };
    return extent(f.y) / std::max(extent(f.x), extent(f.z));
  };
  for (int i = 0; i < 10; ++i) world.step();
  EXPECT_NEAR(flatness(), 1, 0.03);
  for (int i = 0; i < 300; ++i) world.step();
  EXPECT_TRUE(world.all_at_rest());
  EXPECT_GT(flatness(), 0.75);
  EXPECT_LT(flatness(), 0.85);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
