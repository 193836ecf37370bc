#include "app/compare/cost_model.h"

#include <gtest/gtest.h>

#include "app/compare/compare.h"
#include "softbody/world/world.h"
#include "tests/app/scenes.h"
#include "tests/support/change.h"

namespace app {
namespace THIS_FILE {

std::uint64_t tests_of(const softbody::BodiesInMotion& world, std::string_view method) {
  return detected(*collide::find_method(method), world.positions(), world.collision()).counters.pair_tests;
}

TEST(CostModel, IsExactForMethodsWithoutAHashTable) {
  softbody::World world(touching_pair(), {});
  for (const bool self : {true, false}) {
    softbody::change(world, [self](softbody::Scene& s) { s.collision.self_collision = self; });
    compare::CostModel cost_model;
    cost_model.begin(world.positions(), world.collision(), 1);
    for (const char* key : {"brute-force", "bounding-box"}) {
      EXPECT_EQ(cost_model.of(compare::method_index(key)).pair_tests, tests_of(world, key)) << key << self;
    }
  }
}

TEST(CostModel, PredictsAtLeastHalfOfTheTestsAndAtMostBruteForce) {
  const softbody::World world(touching_pair(), {});
  compare::CostModel cost_model;
  cost_model.begin(world.positions(), world.collision(), 1);
  for (const collide::Method& method : collide::method_table()) {
    const std::uint64_t predicted = cost_model.of(compare::method_index(method.key)).pair_tests;
    EXPECT_LE(predicted, tests_of(world, "brute-force")) << method.key;
    EXPECT_GE(2 * predicted, tests_of(world, method.key)) << method.key;
  }
}

TEST(CostModel, LetsSearchesByPlaceRunWhereEachBodyIsLarge) {
  collide::Bodies one;
  std::vector<float> x, y, z;
  constexpr int side = 300;  // a sheet of 90,000 vertices
  for (int i = 0; i < side * side; ++i) {
    x.push_back(0.01f * static_cast<float>(i % side));
    y.push_back(0);
    z.push_back(0.01f * static_cast<float>(i / side));
  }
  one.add(std::make_shared<const collide::Shape>(static_cast<collide::Index>(x.size()),
                                                 std::span<const std::array<collide::Index, 2>>()));
  collide::Settings settings;
  settings.tolerance = 0.009f;
  const collide::Frame frame{x, y, z, &one};
  compare::CostModel cost_model;
  cost_model.begin(frame, settings, 1);
  EXPECT_GT(cost_model.of(compare::method_index("bounding-box")).cost(), compare::Comparison::default_budget);
  for (const collide::Method& method : collide::method_table()) {
    if (method.group != collide::MethodGroup::sorted && method.group != collide::MethodGroup::trees) continue;
    const std::uint64_t predicted = cost_model.of(compare::method_index(method.key)).cost();
    EXPECT_LT(predicted, compare::Comparison::default_budget / 100) << method.key;
    EXPECT_GT(4 * predicted, detected(method, frame, settings).counters.pair_tests) << method.key;
  }
  settings.tolerance = 10;  // then all pairs are nearby
  cost_model.begin(frame, settings, 1);
  EXPECT_GT(cost_model.of(compare::method_index("sorted-grid")).cost(), compare::Comparison::default_budget);
}

TEST(CostModel, LearnsUntilSettingsOrWorldChange) {
  softbody::World world(touching_pair(), {});
  const std::size_t method = compare::method_index("grid-hash");
  compare::CostModel cost_model;
  cost_model.begin(world.positions(), world.collision(), 1);
  const compare::WorkEstimate before = cost_model.of(method);
  cost_model.learn(method, {.hashes = 7, .pair_tests = 9'000'000});
  cost_model.begin(world.positions(), world.collision(), 1);
  EXPECT_EQ(cost_model.of(method).pair_tests, 9'000'000u);
  EXPECT_EQ(cost_model.of(method).hashes, 7u);
  cost_model.begin(world.positions(), world.collision(), 2);
  EXPECT_EQ(cost_model.of(method).pair_tests, before.pair_tests);
  cost_model.learn(method, {.pair_tests = 9'000'000});
  world.drop();  // three bodies instead of two
  cost_model.begin(world.positions(), world.collision(), 2);
  EXPECT_EQ(cost_model.of(method).pair_tests, 20'250'000u);
  collide::Settings other = world.collision();
  other.levels = 5;
  cost_model.begin(world.positions(), other, 2);
  EXPECT_LT(cost_model.of(method).pair_tests, 9'000'000u);
}

TEST(CostModel, PredictsManyHashesForTinyCells) {
  const softbody::World world(touching_pair(), {});
  collide::Bodies many;
  for (int i = 0; i < 3000; ++i) many.add(world.bodies().shape[0]);
  const std::vector<float> line(many.vertex_count(), 0.0f);
  std::vector<float> far(line);
  for (std::size_t i = 0; i < far.size(); ++i) far[i] = 10.0f * static_cast<float>(i / 162);
  collide::Settings settings = world.collision();
  settings.buckets = 1'000'003;
  settings.cell_size = glm::vec3(0.02f);
  compare::CostModel cost_model;
  cost_model.begin({far, line, line, &many}, settings, 1);
  const compare::WorkEstimate work = cost_model.of(compare::method_index("grid-hash"));
  EXPECT_GT(work.cost(), compare::Comparison::default_budget);
  EXPECT_NE(work.in_words().find("million hash evaluations"), std::string::npos);
  EXPECT_EQ(cost_model.of(compare::method_index("brute-force")).in_words(), "118,097 million pair tests");
}

TEST(CostModel, PredictsAllTestsWhereTheCompleteMethodCannotListAllCells) {
  collide::Bodies points;
  const auto point =
      std::make_shared<const collide::Shape>(collide::Index{1}, std::span<const std::array<collide::Index, 2>>());
  for (int i = 0; i < 500'000; ++i) points.add(point);
  std::vector<float> x, zero(points.vertex_count(), 0.0f);
  for (collide::Index i = 0; i < points.vertex_count(); ++i) x.push_back(static_cast<float>(i));
  collide::Settings settings;
  settings.levels = 0;
  settings.buckets = 1'000'003;
  settings.tolerance = 0.1f;
  const auto predicted = [&](float cell_size) {
    settings.cell_size = glm::vec3(cell_size);
    compare::CostModel cost_model;
    cost_model.begin({x, zero, zero, &points}, settings, 1);
    return cost_model.of(compare::method_index("multi-level-sb-complete")).pair_tests;
  };
  const std::uint64_t all = compare::all_pair_tests(points, true);
  EXPECT_EQ(predicted(0.1f / 2.5f), all) << "43 cells a box are too many";
  EXPECT_LT(predicted(0.1f / 1.9f), all / 100) << "24 cells a box are not";
}

}  // namespace THIS_FILE
}  // namespace app
