#include "app/compare/sweep.h"

#include <gtest/gtest.h>

#include "app/base/heap.h"
#include "app/compare/compare.h"
#include "softbody/world/world.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

collide::Workers& alone() {
  static collide::Workers workers(1);
  return workers;
}

const softbody::World& pair_world() {
  static const softbody::World world(touching_pair(), {});
  return world;
}

/// Returns configurations that run quickly: those of the whole sweep with one of the bucket counts.
std::vector<compare::Configuration> some_configurations() {
  std::vector<compare::Configuration> some;
  for (const compare::Configuration& c : compare::sweep_configurations(pair_world())) {
    const bool hashes = collide::method_table()[c.method].uses_hash;
    if (!hashes || c.settings.buckets == compare::sweep_buckets.back()) some.push_back(c);
  }
  return some;
}

compare::SweepReport run(const std::vector<compare::Configuration>& configurations,
                         const compare::SweepLimits& limits) {
  compare::Sweep sweep(pair_world().positions(), configurations, limits, alone());
  while (sweep.step()) continue;
  return sweep.report();
}

std::size_t count(std::string_view method) {
  return static_cast<std::size_t>(std::ranges::count(compare::sweep_configurations(pair_world()),
                                                     compare::method_index(method), &compare::Configuration::method));
}

TEST(SweepConfigurations, CombineAllAxesThatAMethodUses) {
  std::size_t expected = 0;
  for (const collide::Method& method : collide::method_table()) {
    const std::size_t own = (method.uses_levels ? 4 : 1) * (method.uses_hash ? 4 * 5 : 1);
    EXPECT_EQ(count(method.key), own) << method.key;
    expected += own;
  }
  const auto all = compare::sweep_configurations(pair_world());
  EXPECT_EQ(all.size(), expected);
  for (const compare::Configuration& c : all) {
    EXPECT_EQ(collide::problem(c.settings), "");
    if (!collide::method_table()[c.method].uses_hash) continue;
    EXPECT_EQ(c.settings.cell_size, pair_world().automatic_cell_size(c.settings.levels) * static_cast<float>(c.cell));
  }
  EXPECT_EQ(count("multi-level-sb"), 80u);
  EXPECT_EQ(count("brute-force"), 1u);
}

TEST(Sweep, ReportsWhatNewDetectorsFind) {
  const auto configurations = some_configurations();
  const compare::SweepReport report = run(configurations, {.repetitions = 1});
  ASSERT_EQ(report.rows.size(), configurations.size());
  ASSERT_TRUE(report.reference);
  EXPECT_EQ(report.reference->method, compare::method_index("brute-force"));
  EXPECT_EQ(report.reference_note, "");
  EXPECT_GT(report.true_contacts, 0u);
  int smallest_cells = 0;
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    const compare::Configuration& c = configurations[i];
    const collide::Method& method = collide::method_table()[c.method];
    const collide::Result expected = detected(method, pair_world().positions(), c.settings);
    const compare::SweepRow& row = report.rows[i];
    ASSERT_TRUE(row.checked) << method.key;
    EXPECT_EQ(row.not_run, "");
    EXPECT_EQ(row.times.ms.size(), 1u);
    EXPECT_EQ(row.contacts, expected.contacts.size());
    EXPECT_EQ(row.counters.pair_tests, expected.counters.pair_tests);
    EXPECT_EQ(row.counters.hashes, expected.counters.hashes);
    EXPECT_EQ(row.skipped, expected.skipped);
    EXPECT_EQ(row.coverage, expected.coverage);
    EXPECT_EQ(row.precision, 1.0);
    EXPECT_EQ(row.missed, report.true_contacts - row.contacts);
    EXPECT_TRUE(row.recall == 1.0 || !method.exact) << method.key;
    if (method.key == "multi-level-sb" && c.settings.levels == 0 && c.cell == 0.25) {
      EXPECT_LT(row.recall, 0.5) << "the literal method misses contacts of small cells";
      ++smallest_cells;
    }
    if (method.key == "grid-hash") {
      EXPECT_TRUE(row.memory > c.settings.buckets || heap_in_use() == 0) << "at least a byte per bucket";
    }
  }
  EXPECT_EQ(smallest_cells, 1);
}

TEST(Sweep, ListsButDoesNotRunWhatExceedsTheBudget) {
  softbody::World world(touching_pair(), {});
  world.drop();  // a third body, far from the others: only brute force tests all 117,855 pairs of vertices
  compare::Sweep sweep(world.positions(), compare::sweep_configurations(world), {.budget = 110'000, .repetitions = 1},
                       alone());
  while (sweep.step()) continue;
  const compare::SweepReport& report = sweep.report();
  EXPECT_EQ(report.rows[compare::method_index("brute-force")].not_run, "over budget: 117,855 pair tests predicted");
  for (const compare::SweepRow& row : report.rows) {
    EXPECT_EQ(row.checked, row.not_run.empty());
    EXPECT_EQ(row.times.ms.empty(), !row.not_run.empty());
  }
  ASSERT_TRUE(report.reference) << "another exact method is the reference";
  const collide::Method& reference = collide::method_table()[report.reference->method];
  EXPECT_TRUE(reference.exact);
  EXPECT_FALSE(reference.uses_levels || reference.uses_hash);
  EXPECT_EQ(report.reference_note, "brute force is over budget: 117,855 pair tests predicted");
  EXPECT_EQ(report.true_contacts, world.detection().contacts.size());
  const compare::SweepReport none = run(some_configurations(), {.budget = 0});
  EXPECT_FALSE(none.reference);
  for (const compare::SweepRow& row : none.rows) EXPECT_FALSE(row.checked);
}

TEST(Sweep, RepeatsEachConfigurationUntilItTakesTooLong) {
  for (const compare::SweepRow& row : run(some_configurations(), {.repetitions = 3, .repeat_ms = 1e9}).rows)
    EXPECT_EQ(row.times.ms.size(), 3u);
  for (const compare::SweepRow& row : run(some_configurations(), {.repetitions = 3, .repeat_ms = 1e-9}).rows)
    EXPECT_EQ(row.times.ms.size(), 1u) << "but at least once";
}

TEST(Sweep, CanStopAfterAnyStepAndReportsItsProgress) {
  compare::Sweep sweep(pair_world().positions(), some_configurations(), {.repetitions = 2}, alone());
  EXPECT_EQ(sweep.progress(), 0.0);
  double before = 0;
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(sweep.step());
    EXPECT_GE(sweep.progress(), before);
    before = sweep.progress();
  }
  EXPECT_EQ(std::ranges::count(sweep.report().rows, true, &compare::SweepRow::checked), 9)
      << "the first step is the reference";
  while (sweep.step()) continue;
  EXPECT_EQ(sweep.progress(), 1.0);
  EXPECT_FALSE(sweep.step());
}

TEST(ParetoFront, HasThePointsThatNoOtherBeats) {
  EXPECT_TRUE(compare::pareto_front({}).empty());
  const std::vector<compare::Tradeoff> points{{3, 0.1}, {1, 0.5}, {2, 0.5}, {4, 0.2}, {5, 0.0}, {5, 0.0}, {9, 0.0}};
  EXPECT_EQ(compare::pareto_front(points), (std::vector<std::size_t>{1, 0, 4}));
}

TEST(Timings, HasTheMiddleValueAsMedian) {
  EXPECT_EQ((Timings{{3, 1, 2}}.median()), 2);
  EXPECT_EQ((Timings{{4, 1, 2, 9}}.median()), 3);
  EXPECT_EQ((Timings{{4, 1, 2, 9}}.min()), 1);
}

}  // namespace THIS_FILE
}  // namespace app
