// Collision settings changed while a scene runs: whatever a slider does, nothing flies off.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/softbody/helpers.h"
#include "tests/support/change.h"
#include "tests/support/world_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

/// m/s, of the body that is fastest as a whole.
double fastest_body(const World& world) {
  double fastest = 0;
  for (BodyId body = 0; body < WorldTestAccess::solver(world).state().body_count(); ++body) {
    const auto count = static_cast<Index>(world.model(body).mesh.vertices.size());
    glm::dvec3 sum(0.0);
    for (Index v = 0; v < count; ++v) sum += world.particle(body, v).velocity;
    fastest = std::max(fastest, glm::length(sum) / double(count));
  }
  return fastest;
}

TEST(Settings, AWideToleranceAllOfASuddenDoesNotThrowBodiesAbout) {
  for (const double shift : {0.0, 0.002, 0.004}) {  // m: the same bodies come to lie otherwise
    Scene scene = drop_scene();
    for (BodySource& body : scene.bodies) body.position.x += shift;
    scene.collision.tolerance = 0.05f;
    World world(scene, {.threads = 2});
    while (!world.all_at_rest() && world.frame() < 2000) world.step();
    ASSERT_TRUE(world.all_at_rest());
    collide::Settings wide = world.collision();
    wide.tolerance = 0.5f;
    change(world, [&](Scene& s) { s.collision = wide, s.collision.cell_size.reset(); });
    EXPECT_FALSE(world.all_at_rest()) << "new settings wake all";
    double fastest = 0, fastest_particle = 0;
    for (int i = 0; i < 120; ++i) {
      world.step();
      const Measures m = measure(world);
      ASSERT_TRUE(m.finite);
      ASSERT_GT(m.volume_ratio_min, 0.5);
      ASSERT_LT(m.volume_ratio_max, 2.0);
      fastest_particle = std::max(fastest_particle, m.max_speed);
      fastest = std::max(fastest, fastest_body(world));
    }
    EXPECT_GT(fastest_particle, 0.01) << "the contact layer does grow";
    EXPECT_LT(fastest_particle, 10) << shift;
    EXPECT_LT(fastest, 0.5) << shift;
  }
}

TEST(Settings, SelfCollisionOfALoneBodyComesAndGoes) {
  World world(find_scene("cloth", SBCOLLIDE_SCENES), {});
  run(world, 120);
  ASSERT_GT(world.detection().self_contacts, 0u);
  collide::Settings settings = world.collision();
  settings.self_collision = false;
  change(world, [&](Scene& s) { s.collision = settings, s.collision.cell_size.reset(); });
  EXPECT_FALSE(world.plan().has(Stage::detect));
  EXPECT_TRUE(world.detection().contacts.empty());
  Scene scene = world.scene();  // as a reset does
  World again(scene, {});
  run(again, 120);
  EXPECT_TRUE(again.detection().contacts.empty());
  settings.self_collision = true;
  change(again, [&](Scene& s) { s.collision = settings, s.collision.cell_size.reset(); });
  EXPECT_TRUE(again.plan().has(Stage::detect));
  EXPECT_GT(again.detection().self_contacts, 0u);
}

TEST(Settings, AWiderToleranceWakesAPileThatStaysAwakeWhileTheContactLayerGrows) {
  World world(drop_scene(), {});
  run(world, 800);
  ASSERT_TRUE(world.all_at_rest());
  collide::Settings wide = world.collision();
  wide.tolerance = 0.2f;
  change(world, [&](Scene& s) { s.collision = wide, s.collision.cell_size.reset(); });
  const std::size_t before = world.detection().contacts.size();
  run(world, 110);  // 0.1 m at 5 cm a second
  EXPECT_FALSE(world.all_at_rest());
  run(world, 110);
  EXPECT_LT(world.detection().contacts.size(), before) << "penalty contact pushed bodies apart";
}

struct End {
  const char* name;
  int levels;
  std::uint32_t buckets;
  float cell;  // m, 0: the default one
  float tolerance;
};

class SliderEnd : public testing::TestWithParam<End> {};

TEST_P(SliderEnd, KeepsTheRunningSceneWhole) {
  const End& end = GetParam();
  for (const collide::Method& method : collide::method_table()) {
    World world(drop_scene(), {.threads = 2});
    run(world, 330);  // about when bodies roll off the solid sphere against each other
    change(world, [&](Scene& s) { s.method = method.key; });
    change(world, [&](Scene& s) {
      s.collision.levels = end.levels;
      s.collision.buckets = end.buckets;
      s.collision.tolerance = end.tolerance;
      if (end.cell > 0) s.collision.cell_size = glm::vec3(end.cell);
    });
    for (int i = 0; i < 20; ++i) {
      world.step();
      const Measures m = measure(world);
      ASSERT_TRUE(m.finite) << method.key << ", frame " << world.frame();
      ASSERT_LT(m.max_speed, 16) << method.key << ", frame " << world.frame();
    }
  }
}

const End ends[]{
    {"levels_0", 0, 1001, 0, 0.1f},         {"levels_15", 15, 1001, 0, 0.1f},
    {"one_bucket", 3, 1, 0, 0.1f},          {"max_buckets", 3, collide::max_buckets, 0, 0.1f},
    {"tiny_cell", 3, 1001, 0.005f, 0.1f},   {"huge_cell", 3, 1001, 1e6f, 0.1f},
    {"tiny_tolerance", 3, 1001, 0, 0.001f}, {"wide_tolerance", 3, 1001, 0, 1.0f},
};

INSTANTIATE_TEST_SUITE_P(Ends, SliderEnd, testing::ValuesIn(ends), [](const auto& i) { return i.param.name; });

TEST(Settings, OfExactMethodsDoNotChangeTheTrajectory) {
  const auto hash_with = [](const collide::Settings& settings) {
    Scene scene = drop_scene();
    scene.collision = settings;
    World world(scene, {});
    run(world, 250);
    return world.state_hash();
  };
  collide::Settings s = drop_scene().collision;
  const std::uint64_t hash = hash_with(s);
  s.levels = 9;
  s.buckets = 17;
  s.cell_size = glm::vec3(0.11f, 3.0f, 0.4f);
  EXPECT_EQ(hash_with(s), hash);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
