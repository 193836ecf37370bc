// Surface contact may be turned on and off, and leaves vertex contact alone.

#include <gtest/gtest.h>

#include "softbody/integrate/force_stage.h"
#include "tests/softbody/surface_rig.h"
#include "tests/support/change.h"

namespace softbody::test {
namespace THIS_FILE {

/// Four balls that meet in mid-air.
Scene crowd() {
  Scene scene = ball_in_space(rubber(), {4, 0, 0});
  scene.gravity = {0, -9.81, 0};
  set_solid(scene, {Ground{-0.8}, 0.5});
  add_body(scene, {1.2, 0.3, 0}, {-4, 0, 0});
  add_body(scene, {0.5, 1.2, 0.2}, {0, -4, 0});
  add_body(scene, {0.6, 2.3, 0.1}, {0, -8, 0});
  return scene;
}

TEST(SurfaceContact, MayBeTurnedOnAndOffAtAnyTime) {
  World world(crowd(), {});
  Judge judge(world);
  for (int i = 0; i < 60; ++i) {
    if (i % 7 == 3) change(world, [&](Scene& s) { s.contact_surface = ContactSurface::vertices; });
    if (i % 7 == 5) change(world, [&](Scene& s) { s.contact_surface = ContactSurface::surfaces; });
    world.step();
    ASSERT_TRUE(measure(world).finite) << frame_of(world);
    ASSERT_LT(measure(world).max_speed, 40) << frame_of(world);
  }
  change(world, [&](Scene& s) { s.contact_surface = ContactSurface::surfaces; });
  EXPECT_TRUE(world.plan().has(Stage::surface_contact));
  EXPECT_FALSE(world.plan().has(stage_of<PenaltyContact>));
  run(world, 60);
  judge.expect_clean("after a second of surface contact");
}

TEST(SurfaceContact, LeavesVertexContactAsItIs) {
  const auto hash = [](bool to_and_fro) {
    Scene scene = crowd();
    scene.contact_surface = ContactSurface::vertices;
    World world(scene, {});
    if (to_and_fro) {
      change(world, [&](Scene& s) { s.contact_surface = ContactSurface::surfaces; });
      change(world, [&](Scene& s) { s.contact_surface = ContactSurface::vertices; });
    }
    run(world, 30);
    return world.state_hash();
  };
  EXPECT_EQ(hash(true), hash(false));
}

}  // namespace THIS_FILE
}  // namespace softbody::test
