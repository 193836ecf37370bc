#include "app/recall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "app/session.h"
#include "tests/app/scenes.h"

namespace app {
namespace {

using namespace std::chrono_literals;

Snapshot snapshot_of(const softbody::World& world) {
  const collide::Frame frame = world.positions();
  return {.id = 1,
          .x = {frame.x.begin(), frame.x.end()},
          .y = {frame.y.begin(), frame.y.end()},
          .z = {frame.z.begin(), frame.z.end()},
          .bodies = world.bodies(),
          .settings = world.collision(),
          .found = {{world.method().key, world.detection().contacts}}};
}

/// The true contacts, counted here once more and on their own.
std::vector<collide::Contact> true_contacts(const softbody::World& world) {
  const collide::Frame f = world.positions();
  const float tolerance2 = world.collision().tolerance * world.collision().tolerance;
  const auto body = world.vertex_body();
  std::vector<collide::Contact> contacts;
  for (collide::Index a = 0; a < f.x.size(); ++a) {
    for (collide::Index b = a + 1; b < f.x.size(); ++b) {
      if (!(collide::squared_distance(f.x[a], f.y[a], f.z[a], f.x[b], f.y[b], f.z[b]) < tolerance2)) continue;
      const collide::Index first = f.bodies->first[body[a]];
      const bool excluded = body[a] == body[b] && f.bodies->shape[body[a]]->excludes(a - first, b - first, tolerance2);
      if (!excluded) contacts.push_back({a, b});
    }
  }
  return contacts;
}

softbody::World world_with(std::string_view method, float cell) {
  softbody::World world(touching_pair(), {});
  collide::Settings settings = world.collision();
  settings.cell_size = glm::vec3(cell);
  settings.buckets = 1'000'003;  // practically no aliasing, which would hide misses
  world.set_method(method);
  world.set_collision(settings, false);
  return world;
}

TEST(Recall, OfTheLiteralMethodWithTooSmallCellsIsBelowOneAndCountedRight) {
  const softbody::World world = world_with("multi-level-sb", 0.13f);
  const auto truth = true_contacts(world);
  ASSERT_FALSE(truth.empty());
  const auto& found = world.detection().contacts;
  std::vector<collide::Contact> hit;
  std::ranges::set_intersection(truth, found, std::back_inserter(hit));
  const RecallReport report = compare(snapshot_of(world));
  ASSERT_EQ(report.rows.size(), 1u);
  EXPECT_EQ(report.reference, truth.size());
  EXPECT_LT(report.rows[0].recall, 1.0);
  EXPECT_EQ(report.rows[0].recall, static_cast<double>(hit.size()) / static_cast<double>(truth.size()));
  EXPECT_EQ(report.rows[0].missed.size(), truth.size() - hit.size());
  EXPECT_TRUE(report.rows[0].extra.empty());
}

TEST(Recall, OfEveryExactMethodIsOne) {
  for (const collide::Method& method : collide::methods()) {
    if (!method.exact) continue;
    const RecallReport report = compare(snapshot_of(world_with(method.key, 0.13f)));
    EXPECT_GT(report.reference, 0u);
    EXPECT_EQ(report.rows.at(0).recall, 1.0) << method.key;
    EXPECT_TRUE(report.rows.at(0).missed.empty()) << method.key;
    EXPECT_TRUE(report.rows.at(0).extra.empty()) << method.key;
  }
}

TEST(Recall, ComparesAnyNumberOfCandidates) {
  Snapshot snapshot = snapshot_of(world_with("brute-force", 0.5f));
  const auto truth = snapshot.found[0].contacts;
  snapshot.found.push_back({"nothing", {}});
  snapshot.found.push_back({"too-much", truth});
  snapshot.found.back().contacts.push_back({100'000, 100'001});
  const RecallReport report = compare(snapshot);
  ASSERT_EQ(report.rows.size(), 3u);
  EXPECT_EQ(report.rows[1].recall, 0.0);
  EXPECT_EQ(report.rows[1].missed, truth);
  EXPECT_EQ(report.rows[2].recall, 1.0);
  EXPECT_EQ(report.rows[2].extra.size(), 1u);
}

TEST(Recall, WithoutContactsIsOne) {
  Snapshot snapshot = snapshot_of(world_with("brute-force", 0.5f));
  snapshot.settings.tolerance = 1e-6f;
  snapshot.found[0].contacts.clear();
  EXPECT_EQ(compare(snapshot).rows.at(0).recall, 1.0);
}

TEST(Recall, PredictsThePairTestsOfBruteForce) {
  const softbody::World world(touching_pair(), {});
  EXPECT_EQ(predicted_pair_tests(world.bodies(), true), 324u * 323u / 2);
  EXPECT_EQ(predicted_pair_tests(world.bodies(), false), 162u * 162u);
  EXPECT_EQ(predicted_pair_tests({}, true), 0u);
}

/// Waits for a report, as the demo never does.
std::optional<RecallReport> wait_for_report(RecallWorker& worker) {
  for (const auto end = std::chrono::steady_clock::now() + 60s; std::chrono::steady_clock::now() < end;) {
    if (auto report = worker.take()) return report;
    std::this_thread::sleep_for(1ms);
  }
  return std::nullopt;
}

TEST(RecallWorker, ReportsOnWhatItWasGiven) {
  RecallWorker worker;
  EXPECT_TRUE(worker.ready());
  Snapshot snapshot = snapshot_of(world_with("multi-level-sb", 0.13f));
  snapshot.id = 42;
  const RecallReport expected = compare(snapshot);
  worker.offer(snapshot);
  const auto report = wait_for_report(worker);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->id, 42u);
  EXPECT_EQ(report->reference, expected.reference);
  EXPECT_EQ(report->rows.at(0).missed, expected.rows.at(0).missed);
  EXPECT_FALSE(worker.take());
}

TEST(Recall, SaysWhyTooManyBodiesAreNotCompared) {
  const softbody::World world(touching_pair(), {});
  EXPECT_EQ(refusal(world.bodies(), true), "");
  collide::Bodies many;
  for (int i = 0; i < 3000; ++i) many.add(world.bodies().shape[0]);
  EXPECT_NE(refusal(many, true).find("million pair tests"), std::string::npos);
}

TEST(RecallWorker, MayBeDestroyedWhileItWorks) {
  for (int i = 0; i < 20; ++i) {
    RecallWorker worker;
    worker.offer(snapshot_of(world_with("brute-force", 0.5f)));
  }
}

}  // namespace
}  // namespace app
