// Collision settings changed while a scene runs: whatever a slider does, nothing flies off.

#include <gtest/gtest.h>

#include "softbody/world/snapshot.h"
#include "tests/softbody/helpers.h"
#include "tests/support/change.h"

namespace softbody::test {
namespace THIS_FILE {

TEST(Tolerance, ThrowsNoBodiesAboutWhenItGrowsAllOfASudden) {
  for (const double shift : {0.0, 0.002, 0.004}) {  // m: the same bodies come to lie otherwise
    Scene scene = drop_scene();
    for (BodySource& body : scene.bodies) body.position.x += shift;
    scene.collision.tolerance = 0.05f;
    World world(scene, {.threads = 2});
    while (!world.all_at_rest() && world.frame() < 2000) world.step();
    ASSERT_TRUE(world.all_at_rest());
    change(world, [](Scene& s) { s.collision.tolerance = 0.5f; });
    EXPECT_FALSE(world.all_at_rest()) << "new settings wake all";
    double fastest = 0, fastest_particle = 0;
    for (int i = 0; i < 120; ++i) {
      world.step();
      const Measures m = measure(world);
      ASSERT_TRUE(m.finite);
      ASSERT_GT(m.volume_ratio_min, 0.5);
      ASSERT_LT(m.volume_ratio_max, 2.0);
      fastest_particle = std::max(fastest_particle, m.max_speed);
      for (BodyId b = 0; b < world.bodies().count(); ++b)
        fastest = std::max(fastest, glm::length(motion(world, b).velocity));
    }
    EXPECT_GT(fastest_particle, 0.01) << "the contact layer does grow";
    EXPECT_LT(fastest_particle, 10) << shift;
    EXPECT_LT(fastest, 0.5) << shift;
  }
}

TEST(SelfCollision, ComesAndGoesForALoneBody) {
  World world(find_scene("cloth", SBCOLLIDE_SCENES), {});
  run(world, 120);
  ASSERT_GT(world.detection().self_contacts, 0u);
  change(world, [](Scene& s) { s.collision.self_collision = false; });
  EXPECT_FALSE(world.plan().has(Stage::detect));
  EXPECT_TRUE(world.detection().contacts.empty());
  World again(world.scene(), {});  // as a reset does
  run(again, 120);
  EXPECT_TRUE(again.detection().contacts.empty());
  change(again, [](Scene& s) { s.collision.self_collision = true; });
  EXPECT_TRUE(again.plan().has(Stage::detect));
  EXPECT_GT(again.detection().self_contacts, 0u);
}

TEST(Tolerance, KeepsAPileAwakeWhileTheContactLayerGrows) {
  World world(drop_scene(), {});
  run(world, 800);
  ASSERT_TRUE(world.all_at_rest());
  change(world, [](Scene& s) { s.collision.tolerance = 0.2f; });
  const std::size_t before = world.detection().contacts.size();
  run(world, 110);  // 0.1 m at 5 cm a second
  EXPECT_FALSE(world.all_at_rest());
  run(world, 110);
  EXPECT_LT(world.detection().contacts.size(), before) << "penalty contact pushed bodies apart";
}

TEST(Settings, KeepTheRunningSceneWholeAtEachEndOfTheirSliders) {
  const struct {
    const char* name;
    int levels;
    std::uint32_t buckets;
    float cell;  // m, 0: the default one
    float tolerance;
  } ends[]{
      {"levels 0", 0, 1001, 0, 0.1f},         {"levels 15", 15, 1001, 0, 0.1f},
      {"one bucket", 3, 1, 0, 0.1f},          {"most buckets", 3, collide::max_buckets, 0, 0.1f},
      {"tiny cell", 3, 1001, 0.005f, 0.1f},   {"huge cell", 3, 1001, 1e6f, 0.1f},
      {"tiny tolerance", 3, 1001, 0, 0.001f}, {"wide tolerance", 3, 1001, 0, 1.0f},
  };
  World world(drop_scene(), {.threads = 2});
  run(world, 330);  // about when bodies roll off the solid sphere against each other
  const Snapshot before = world.snapshot();
  for (const auto& end : ends)
    for (const collide::Method& method : collide::method_table()) {
      SCOPED_TRACE(end.name);
      SCOPED_TRACE(method.key);
      world.restore(before);
      change(world, [&](Scene& s) {
        s.method = method.key;
        s.collision.levels = end.levels;
        s.collision.buckets = end.buckets;
        s.collision.tolerance = end.tolerance;
        if (end.cell > 0) s.collision.cell_size = glm::vec3(end.cell);
      });
      for (int i = 0; i < 20; ++i) {
        world.step();
        const Measures m = measure(world);
        ASSERT_TRUE(m.finite) << "frame " << world.frame();
        ASSERT_LT(m.max_speed, 16) << "frame " << world.frame();
      }
    }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
