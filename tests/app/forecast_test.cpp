#include "app/compare/forecast.h"

#include <gtest/gtest.h>

#include "app/compare/compare.h"
#include "softbody/world.h"
#include "tests/app/scenes.h"

namespace app {
namespace {

std::uint64_t tests_of(const softbody::World& world, std::string_view method) {
  collide::Workers alone(1);
  collide::Result result;
  collide::find_method(method)->make()->detect(world.positions(), world.collision(), alone, result);
  return result.counters.pair_tests;
}

TEST(Forecast, IsExactForMethodsWithoutAHashTable) {
  softbody::World world(touching_pair(), {});
  collide::Settings settings = world.collision();
  for (const bool self : {true, false}) {
    settings.self_collision = self;
    world.set_collision(settings, true);
    Forecast forecast;
    forecast.begin(world.positions(), settings, 1);
    for (const char* key : {"brute-force", "bounding-box"}) {
      EXPECT_EQ(forecast.of(method_index(key)).pair_tests, tests_of(world, key)) << key << self;
    }
  }
}

TEST(Forecast, OfHashMethodsIsNeverMoreThanBruteForceAndNotMuchTooSmall) {
  const softbody::World world(touching_pair(), {});
  Forecast forecast;
  forecast.begin(world.positions(), world.collision(), 1);
  for (const collide::Method& method : collide::method_table()) {
    const std::uint64_t predicted = forecast.of(method_index(method.key)).pair_tests;
    EXPECT_LE(predicted, tests_of(world, "brute-force")) << method.key;
    EXPECT_GE(2 * predicted, tests_of(world, method.key)) << method.key;
  }
}

TEST(Forecast, LearnsUntilSettingsOrWorldChange) {
  softbody::World world(touching_pair(), {});
  const std::size_t method = method_index("grid-hash");
  Forecast forecast;
  forecast.begin(world.positions(), world.collision(), 1);
  const Work before = forecast.of(method);
  forecast.learn(method, {.hashes = 7, .pair_tests = 9'000'000});
  forecast.begin(world.positions(), world.collision(), 1);
  EXPECT_EQ(forecast.of(method).pair_tests, 9'000'000u);
  EXPECT_EQ(forecast.of(method).hashes, 7u);
  forecast.begin(world.positions(), world.collision(), 2);
  EXPECT_EQ(forecast.of(method).pair_tests, before.pair_tests);
  forecast.learn(method, {.pair_tests = 9'000'000});
  world.drop();  // three bodies instead of two
  forecast.begin(world.positions(), world.collision(), 2);
  EXPECT_EQ(forecast.of(method).pair_tests, 20'250'000u);
  collide::Settings other = world.collision();
  other.levels = 5;
  forecast.begin(world.positions(), other, 2);
  EXPECT_LT(forecast.of(method).pair_tests, 9'000'000u);
}

TEST(Forecast, SeesThatTinyCellsCostHashes) {
  const softbody::World world(touching_pair(), {});
  collide::Bodies many;
  for (int i = 0; i < 3000; ++i) many.add(world.bodies().shape[0]);
  const std::vector<float> line(many.vertex_count(), 0.0f);
  std::vector<float> far(line);
  for (std::size_t i = 0; i < far.size(); ++i) far[i] = 10.0f * static_cast<float>(i / 162);
  collide::Settings settings = world.collision();
  settings.buckets = 1'000'003;
  settings.cell_size = glm::vec3(0.02f);
  Forecast forecast;
  forecast.begin({far, line, line, &many}, settings, 1);
  const Work work = forecast.of(method_index("grid-hash"));
  EXPECT_GT(work.cost(), Comparison::usual_budget);
  EXPECT_NE(work.in_words().find("million hash evaluations"), std::string::npos);
  EXPECT_EQ(forecast.of(method_index("brute-force")).in_words(), "118,097 million pair tests");
}

}  // namespace
}  // namespace app
