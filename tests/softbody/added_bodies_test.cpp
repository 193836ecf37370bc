// Bodies that no scene brought: the scene that brings them itself.

#include <gtest/gtest.h>

#include "softbody/world/snapshot.h"
#include "tests/softbody/helpers.h"

namespace softbody {
namespace THIS_FILE {

/// The hash after so many frames of a world whose scene brings what was added to this one.
std::uint64_t hash_of_scene(const World& world) {
  Scene scene = world.scene();
  scene.bodies = body_sources(world);
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
    BodySource source = body_sources(world).front();
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
