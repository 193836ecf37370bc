// Bodies that no scene brought: the scene that brings them itself.

#include <gtest/gtest.h>

#include "softbody/world/snapshot.h"
#include "tests/softbody/helpers.h"

namespace softbody {
namespace THIS_FILE {

/// The hash after so many frames of a world whose scene brings what was added to this one.
std::uint64_t hash_of_scene(const World& world) {
  Scene scene = world.scene();
  scene.bodies = world.body_sources();
  World again(std::move(scene), {.threads = 2});
  EXPECT_TRUE(again.added().empty());
  test::run(again, world.frame());
  return again.state_hash();
}

TEST(AddedBodies, BroughtByTheSceneItselfGoTheSameWayToTheBit) {
  for (const char* key : {"drop", "A", "cloth"}) {
    SCOPED_TRACE(key);
    World world(find_scene(key, SBCOLLIDE_SCENES), {.threads = 2});
    world.drop(3);  // before the first frame
    test::run(world, 30);
    world.drop();
    ASSERT_TRUE(world.throw_body({6, 2, 0}, {-5, 1, 0}));
    test::run(world, 60);
    BodySource source = world.body_sources().front();
    source.position = {4, 6, 1};
    world.add(source);
    test::run(world, 10);
    ASSERT_EQ(world.added().size(), 6u);
    EXPECT_EQ(hash_of_scene(world), world.state_hash());
  }
}

TEST(AddedBodies, ComeBeforeThoseThatTheSceneBringsInTheNextStep) {
  const Scene scene = find_scene("drop", SBCOLLIDE_SCENES);
  const int late = scene.bodies.back().appear;
  ASSERT_GT(late, 0);
  World world(scene, {.threads = 2});
  test::run(world, late);
  const std::size_t before = world.bodies().count();
  world.drop(2);
  world.step();
  ASSERT_EQ(world.bodies().count(), before + 3);
  EXPECT_EQ(hash_of_scene(world), world.state_hash());
}

/// By hand held and let go: a vertex that falls, some of those that a scene's hold turns, and all of an added body.
TEST(ChangedHolds, GoTheSameWayToTheBitFromTheSceneThatIsSaved) {
  const test::TemporaryFolder folder;
  for (const char* integrator : {"auto", "xpbd", "implicit"}) {
    SCOPED_TRACE(integrator);
    const World::Options options{.integrator = {.key = integrator}};
    Scene scene;
    scene.materials.resize(1);
    Hold side{.where = SolidBox{.centre = {-0.5, 2, 0}, .half_size = {0.01, 0.01, 1}}};
    side.velocity = {0.1, 0, 0};
    side.turn = {.axis = {1, 0, 0}, .degrees_per_second = 90};
    side.through = {0, 2, 0};
    scene.bodies = {{.mesh = {.kind = "grid", .columns = 6, .rows = 6, .width = 1, .depth = 1},
                     .position = {0, 2, 0},
                     .holds = {side}},
                    {.mesh = {.subdivisions = 1}, .position = {3, 2, 0}, .appear = 4, .release = 4}};
    World world(scene, options);
    world.switch_hold(0, 0);  // at one end of the side
    test::run(world, 10);
    const BodyId added = world.add({.mesh = {.subdivisions = 1},
                                    .position = {-3, 2, 0},
                                    .holds = {{.where = SolidSphere{.centre = {-3, 2, 0}, .radius = 1}}}});
    EXPECT_TRUE(world.switch_hold(1, 5));
    test::run(world, 10);
    EXPECT_EQ(world.particle(1, 5).velocity, glm::dvec3(0.0));
    EXPECT_FALSE(world.switch_hold(added, 7));
    EXPECT_FALSE(world.switch_hold(0, 42));  // the other end
    test::run(world, 10);
    EXPECT_FALSE(world.switch_hold(1, 5));
    EXPECT_TRUE(world.switch_hold(1, 5));
    EXPECT_FALSE(world.switch_hold(1, 5));
    EXPECT_NE(world.particle(0, 42).velocity, world.particle(0, 0).velocity);
    test::run(world, 5);
    EXPECT_TRUE(world.scene() == scene) << "what a restart takes";
    scene.bodies = world.body_sources();
    EXPECT_EQ(scene.bodies[1].holds.size(), 1u) << "nobody saw the others";
    const Scene saved = load_scene(folder.write("saved.toml", scene_toml(scene, folder.path())));
    EXPECT_EQ(saved.bodies, scene.bodies);
    World again(saved, options);
    test::run(again, world.frame());
    EXPECT_EQ(again.state_hash(), world.state_hash());
  }
}

TEST(ChangedHolds, AreSavedAndLetGoByAWorldThatHasCopiedThem) {
  const Scene scene = find_scene("A", SBCOLLIDE_SCENES);
  World first(scene, {}), second(scene, {});
  for (World* world : {&first, &second}) {
    test::run(*world, 3);
    world->drop();
  }
  const BodyId added = first.added().front().body;
  for (const BodyId body : {BodyId(0), added}) EXPECT_TRUE(first.switch_hold(body, 5));
  second.copy_holds(first);
  EXPECT_EQ(second.body_sources(), first.body_sources());
  test::run(second, 5);
  for (const BodyId body : {BodyId(0), added}) EXPECT_FALSE(second.switch_hold(body, 5));
  test::run(second, 5);
  EXPECT_EQ(hash_of_scene(second), second.state_hash());
}

TEST(AddedBodies, LeaveWithTheirBodiesAndComeBackWithTheirSnapshot) {
  World world(find_scene("A", SBCOLLIDE_SCENES), {});
  const auto ids = [&] {
    std::vector<BodyId> list;
    for (const AddedBody& one : world.added()) list.push_back(one.body);
    return list;
  };
  const BodyId first = world.bodies().count();
  world.drop(3);
  const Snapshot three = world.snapshot();
  world.remove(first + 1);
  EXPECT_EQ(ids(), (std::vector{first, first + 1}));
  world.remove(0);  // one of the scene's own
  EXPECT_EQ(ids(), (std::vector{first - 1, first}));
  world.restore(three);
  EXPECT_EQ(ids(), (std::vector{first, first + 1, first + 2}));
}

}  // namespace THIS_FILE
}  // namespace softbody
