// Every method on every state with every kind of settings, against the oracle. One detector of each method sees all of
// them one after another, so that anything it keeps from an earlier frame would show.

#include <gtest/gtest.h>

#include <algorithm>

#include "every_target.h"

namespace collide::test {
namespace THIS_FILE {

constexpr std::array levels{0, 1, 3, 6, 9, 15};
constexpr std::array<std::uint32_t, 5> buckets{1, 2, 101, 1001, 65537};

/// Cell sizes from far too small to far too large, and the default.
std::vector<glm::vec3> cell_sizes(const State& state, int level) {
  return {glm::vec3(1e-6f),
          glm::vec3(0.5f * state.tolerance),
          glm::vec3(0.25f),
          glm::vec3(1, 0.3f, 2.5f),
          glm::vec3(1e6f, 1e30f, 1e-30f),
          automatic_cell_size(state.frame(), level, state.tolerance)};
}

std::vector<Settings> all_settings(const State& state, const Method& method) {
  std::vector<Settings> all;
  for (const int level : method.uses_levels ? std::vector<int>(levels.begin(), levels.end()) : std::vector<int>{3}) {
    for (const std::uint32_t count :
         method.uses_hash ? std::vector(buckets.begin(), buckets.end()) : std::vector{101u}) {
      for (const glm::vec3& cell : cell_sizes(state, level)) {
        all.push_back({.tolerance = state.tolerance, .levels = level, .buckets = count, .cell_size = cell});
        if (!method.uses_hash) break;
      }
    }
  }
  return all;
}

std::string describe(const Method& method, const Settings& settings) {
  return std::string(method.key) + ", levels " + std::to_string(settings.levels) + ", buckets " +
         std::to_string(settings.buckets) + ", cell " + std::to_string(settings.cell_size->x) +
         (settings.self_collision ? "" : ", no self-collision");
}

/// Detectors and threads that outlive the tests.
struct Bench {
  std::vector<std::unique_ptr<Detector>> detectors;
  std::array<Workers, 3> workers{Workers(1), Workers(2, 0), Workers(3, 0)};
  std::size_t runs = 0;

  Bench() {
    for (const Method& method : method_table()) detectors.push_back(method.make());
  }
};

class Matrix : public testing::TestWithParam<NamedState> {
 protected:
  static void SetUpTestSuite() { bench_ = new Bench; }
  static void TearDownTestSuite() { delete bench_; }
  static Bench* bench_;
};
Bench* Matrix::bench_ = nullptr;

TEST_P(Matrix, FindsWhatTheOracleFinds) {
  const State state = GetParam().make();
  Settings settings{.tolerance = state.tolerance};
  const std::vector<Contact> with_self = oracle(state, settings);
  settings.self_collision = false;
  const std::vector<Contact> between = oracle(state, settings);
  const std::size_t inside = inside_bodies(state, with_self).size();
  ASSERT_EQ(inside, with_self.size() - between.size());
  std::vector<Index> non_finite;
  for (Index body = 0; body < state.bodies.count(); ++body)
    if (!finite(state, body)) non_finite.push_back(body);

  for (std::size_t m = 0; m < method_table().size(); ++m) {
    const Method& method = method_table()[m];
    for (Settings tried : all_settings(state, method)) {
      tried.self_collision = bench_->runs % 4 != 3;
      Workers& workers = bench_->workers[++bench_->runs % bench_->workers.size()];
      const std::vector<Contact>& expected = tried.self_collision ? with_self : between;
      Result result;
      bench_->detectors[m]->detect(state.frame(), tried, workers, result);
      ASSERT_EQ(result.non_finite_bodies, non_finite) << describe(method, tried);
      if (method.exact) {
        ASSERT_EQ(result.contacts, expected) << describe(method, tried);
        ASSERT_EQ(result.self_contacts, tried.self_collision ? inside : 0) << describe(method, tried);
        ASSERT_EQ(result.coverage, Coverage::exact);
      } else {
        ASSERT_TRUE(std::is_sorted(result.contacts.begin(), result.contacts.end()));
        ASSERT_EQ(std::adjacent_find(result.contacts.begin(), result.contacts.end()), result.contacts.end());
        ASSERT_TRUE(std::includes(expected.begin(), expected.end(), result.contacts.begin(), result.contacts.end()))
            << describe(method, tried);
        ASSERT_EQ(result.self_contacts, inside_bodies(state, result.contacts).size());
      }
    }
  }
}

/// Whole results, counters and all, on 1, 2 and 3 threads, by one detector again and by fresh ones.
TEST_P(Matrix, FindsTheSameOnAnyNumberOfThreadsAndTheNextTime) {
  const State state = GetParam().make();
  const State other = named_states()[1].make();
  for (const Method& method : method_table()) {
    for (const float cell : {0.02f, 0.6f}) {
      const Settings settings{.tolerance = state.tolerance, .cell_size = glm::vec3(cell)};
      const Settings before{.tolerance = other.tolerance, .cell_size = glm::vec3(cell)};
      const Result first = detect(method.key, state, settings);
      const std::unique_ptr<Detector> kept = method.make();
      for (Workers& workers : bench_->workers) {
        Result result;
        kept->detect(other.frame(), before, workers, result);
        kept->detect(state.frame(), settings, workers, result);
        EXPECT_EQ(result.contacts, first.contacts) << method.key;
        EXPECT_EQ(result.self_contacts, first.self_contacts) << method.key;
        EXPECT_EQ(result.counters.pair_tests, first.counters.pair_tests) << method.key;
        EXPECT_EQ(result.counters.hashes, first.counters.hashes) << method.key;
        EXPECT_EQ(result.counters.boxes, first.counters.boxes) << method.key;
        EXPECT_EQ(result.coverage, first.coverage) << method.key;
        EXPECT_EQ(result.non_finite_bodies, first.non_finite_bodies) << method.key;
      }
    }
  }
}

/// Four frames each: from the third on, the exact method keeps the contacts of bodies at rest.
TEST_P(Matrix, FindsTheSameContactsOnEveryTarget) {
  const State state = GetParam().make();
  const Settings settings{.tolerance = state.tolerance, .cell_size = glm::vec3(0.6f)};
  for (const Method& method : method_table()) {
    const std::vector<Contact> expected = detect(method.key, state, settings).contacts;
    for (const std::int64_t target : targets()) {
      const tests::UseTarget use(target);
      const std::unique_ptr<Detector> detector = method.make();
      for (int frame = 0; frame < 4; ++frame) {
        Result result;
        detector->detect(state.frame(), settings, bench_->workers[1], result);
        ASSERT_EQ(result.contacts, expected) << method.key << ' ' << hwy::TargetName(target) << ' ' << frame;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(States, Matrix, testing::ValuesIn(named_states()),
                         [](const auto& state) { return state.param.name; });

}  // namespace THIS_FILE
}  // namespace collide::test
