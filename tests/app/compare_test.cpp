#include "app/compare/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "softbody/world/world.h"
#include "tests/app/scenes.h"
#include "tests/support/change.h"

namespace app {
namespace THIS_FILE {

constexpr std::uint32_t seed = 7;

compare::FrameSnapshot snapshot_of(const softbody::BodiesInMotion& world) {
  compare::FrameSnapshot snapshot;
  snapshot.id = snapshot.world = 1;
  snapshot.copy(world.positions());
  snapshot.settings = world.collision();
  snapshot.driver = compare::method_index(world.method().key);
  snapshot.found = world.detection();
  snapshot.chosen.assign(collide::method_table().size(), true);
  return snapshot;
}

compare::CompareReport compare_on(const compare::FrameSnapshot& snapshot,
                                  std::uint64_t budget = compare::Comparison::default_budget) {
  Background<compare::Comparison> comparison(Runs::in_slices, seed, budget);
  comparison.offer(snapshot);
  return *comparison.wait();
}

softbody::World world_with(std::string_view method, float cell) {
  softbody::Scene scene = touching_pair();
  scene.method = method;
  scene.collision.cell_size = glm::vec3(cell);
  scene.collision.buckets = 1'000'003;  // almost no aliasing, which would hide missed contacts
  return softbody::World(scene, {});
}

// With three bodies brute force takes 117,855 pair tests; all other methods stay within the budget.
constexpr std::uint64_t tight_budget = 110'000;
softbody::World three_bodies(std::string_view method) {
  softbody::World world = world_with(method, 2.0f);
  world.drop();
  // Detects twice more.
  for (const int by : {1, -1}) softbody::change(world, [by](softbody::Scene& s) { s.collision.buckets += by; });
  return world;
}

const compare::CompareRow& row(const compare::CompareReport& report, std::string_view key) {
  return report.rows[compare::method_index(key)];
}

TEST(Comparison, ReportsWhatTheDetectorsFind) {
  const softbody::World world = world_with("multi-level-sb", 0.13f);
  const compare::CompareReport report = compare_on(snapshot_of(world));
  EXPECT_EQ(report.id, 1u);
  ASSERT_EQ(report.rows.size(), collide::method_table().size());
  for (const collide::Method& method : collide::method_table()) {
    const collide::Result expected = detected(method, world.positions(), world.collision());
    const compare::CompareRow& measured = row(report, method.key);
    ASSERT_TRUE(measured.scored) << method.key;
    EXPECT_EQ(measured.contacts, expected.contacts.size()) << method.key;
    EXPECT_EQ(measured.counters.pair_tests, expected.counters.pair_tests) << method.key;
    EXPECT_EQ(measured.counters.hashes, expected.counters.hashes) << method.key;
    EXPECT_EQ(measured.coverage, expected.coverage) << method.key;
    EXPECT_EQ(measured.ms.has_value(), method.key != "brute-force") << method.key;
    EXPECT_EQ(measured.not_run, "") << method.key;
    EXPECT_TRUE(!method.exact || (measured.recall == 1 && measured.precision == 1)) << method.key;
  }
}

TEST(Comparison, CountsContactsThatTheLiteralMethodMissesWithSmallCells) {
  const softbody::World world = world_with("grid-hash", 0.13f);
  const auto truth = true_contacts(world);
  ASSERT_FALSE(truth.empty());
  std::vector<collide::Contact> hit, missed;
  const softbody::World literal = world_with("multi-level-sb", 0.13f);
  std::ranges::set_intersection(truth, literal.detection().contacts, std::back_inserter(hit));
  std::ranges::set_difference(truth, hit, std::back_inserter(missed));
  const compare::CompareReport report = compare_on(snapshot_of(world));
  EXPECT_EQ(report.true_contacts, truth.size());
  const compare::CompareRow& measured = row(report, "multi-level-sb");
  EXPECT_LT(measured.recall, 1.0);
  EXPECT_EQ(measured.recall, static_cast<double>(hit.size()) / static_cast<double>(truth.size()));
  EXPECT_EQ(measured.precision, 1.0);
  EXPECT_EQ(measured.missed, missed);
  EXPECT_EQ(measured.coverage, collide::Coverage::exceeded);
}

TEST(Comparison, ScoresTheDriverByItsOwnResult) {
  compare::FrameSnapshot snapshot = snapshot_of(world_with("grid-hash", 0.5f));
  snapshot.chosen.clear();
  const std::size_t all = snapshot.found.contacts.size();
  snapshot.found.contacts.erase(snapshot.found.contacts.begin());
  snapshot.found.contacts.push_back({100'000, 100'001});
  const compare::CompareReport report = compare_on(snapshot);
  const compare::CompareRow& driver = row(report, "grid-hash");
  EXPECT_EQ(driver.missed.size(), 1u);
  EXPECT_EQ(driver.recall, static_cast<double>(all - 1) / static_cast<double>(all));
  EXPECT_EQ(driver.precision, driver.recall);
  EXPECT_FALSE(driver.ms);
  EXPECT_FALSE(row(report, "bounding-box").scored);  // no other method was chosen
  EXPECT_TRUE(report.order.empty());
}

TEST(Comparison, CountsTheDriversWorkFromScratch) {
  compare::FrameSnapshot snapshot = snapshot_of(world_with("multi-level-sb-exact", 0.5f));
  snapshot.found.counters = {};  // of a frame in which all bodies rested
  const compare::CompareReport report = compare_on(snapshot);
  EXPECT_GT(row(report, "multi-level-sb-exact").counters.pair_tests, 0u);
}

TEST(Comparison, HasRecallAndPrecisionOneWithoutContacts) {
  compare::FrameSnapshot snapshot = snapshot_of(world_with("brute-force", 0.5f));
  snapshot.settings.tolerance = 1e-6f;
  snapshot.found = {};
  for (const compare::CompareRow& each : compare_on(snapshot).rows) {
    EXPECT_EQ(each.recall, 1.0);
    EXPECT_EQ(each.precision, 1.0);
  }
}

TEST(Comparison, RunsOnlyChosenMethods) {
  compare::FrameSnapshot snapshot = snapshot_of(world_with("multi-level-sb", 0.5f));
  snapshot.chosen.assign(collide::method_table().size(), false);
  snapshot.chosen[compare::method_index("bounding-box")] = true;
  const compare::CompareReport report = compare_on(snapshot);
  EXPECT_EQ(report.order, std::vector{compare::method_index("bounding-box")});
  for (const collide::Method& method : collide::method_table()) {
    EXPECT_EQ(row(report, method.key).ms.has_value(), method.key == "bounding-box") << method.key;
  }
}

TEST(Comparison, ShufflesEachRunAndRepeatsForTheSameSeed) {
  const compare::FrameSnapshot snapshot = snapshot_of(world_with("multi-level-sb-exact", 0.5f));
  Background<compare::Comparison> one(Runs::in_slices, seed), same(Runs::on_thread, seed);
  std::set<std::vector<std::size_t>> orders;
  for (int i = 0; i < 12; ++i) {
    one.offer(snapshot);
    same.offer(snapshot);
    const auto order = one.wait()->order;
    EXPECT_EQ(order, same.wait()->order);
    EXPECT_EQ(order.size(), collide::method_table().size() - 1);
    EXPECT_EQ(std::ranges::count(order, compare::method_index("brute-force")), 0);
    orders.insert(order);
  }
  EXPECT_GT(orders.size(), 6u);
}

TEST(Comparison, ReportsMethodsThatExceedTheBudget) {
  const compare::FrameSnapshot snapshot = snapshot_of(three_bodies("multi-level-sb-exact"));
  const compare::CompareReport report = compare_on(snapshot, tight_budget);
  EXPECT_EQ(row(report, "brute-force").not_run, "not run: 117,855 pair tests predicted");
  EXPECT_FALSE(row(report, "brute-force").scored);
  EXPECT_TRUE(row(report, "multi-level-sb-exact").scored);  // the driver has run anyway
  const compare::CompareReport none = compare_on(snapshot, 10);
  EXPECT_TRUE(none.order.empty());
  EXPECT_FALSE(none.reference);
  EXPECT_EQ(none.reference_note, "brute force would take 117,855 pair tests");
}

TEST(Comparison, UsesAnIndependentExactReferenceIfBruteForceIsTooSlow) {
  for (const collide::Method& driver : collide::method_table()) {
    if (driver.key == "brute-force") continue;
    const softbody::World world = three_bodies(driver.key);
    const compare::CompareReport report = compare_on(snapshot_of(world), tight_budget);
    ASSERT_TRUE(report.reference) << driver.key;
    const collide::Method& reference = collide::method_table()[*report.reference];
    EXPECT_EQ(reference.key, driver.group != collide::MethodGroup::paper ? "multi-level-sb-exact"
                             : driver.uses_hash                          ? "bounding-box"
                                                                         : "grid-hash")
        << driver.key;
    EXPECT_EQ(report.true_contacts, true_contacts(world).size());
    EXPECT_EQ(report.reference_note, "brute force would take 117,855 pair tests");
  }
}

TEST(Comparison, TimesOneMethodAPart) {
  Background<compare::Comparison> comparison(Runs::in_slices, seed);
  comparison.offer(snapshot_of(world_with("multi-level-sb", 0.13f)));
  std::size_t parts = 1;
  std::optional<compare::CompareReport> report;
  for (; !(report = comparison.take({})); ++parts) EXPECT_TRUE(comparison.has_work());
  EXPECT_EQ(parts, report->order.size() + 1) << "the last part scores";
}

TEST(MeanMs, PreparesEachRunAndTakesTime) {
  int prepared = 0, runs = 0;
  const double ms = mean_ms([&] { ++prepared; }, [&] { ++runs; });
  EXPECT_EQ(prepared, runs);
  EXPECT_GE(runs, 1);
  EXPECT_GT(ms, 0);
}

}  // namespace THIS_FILE
}  // namespace app
