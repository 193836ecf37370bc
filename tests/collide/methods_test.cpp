#include "collide/methods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "states.h"
#include "tests/own_process.h"

namespace collide::test {
namespace THIS_FILE {

TEST(MethodKeys, AreThoseOfTheCommandLine) {
  EXPECT_EQ(method_keys(),
            "brute-force, grid-hash, bounding-box, bounding-box-grid-hash, multi-level-sb, multi-level-sb-complete, "
            "multi-level-sb-exact, sorted-grid, sweep-and-prune, aabb-tree, kd-tree, octree");
  EXPECT_NE(find_method(default_method), nullptr);
  EXPECT_EQ(find_method("nearly"), nullptr);
}

TEST(Methods, HaveTextsOfTheirOwn) {
  std::set<std::string_view> keys, names, summaries, descriptions;
  for (const Method& method : method_table()) {
    keys.insert(method.key);
    names.insert(method.name);
    summaries.insert(method.summary);
    descriptions.insert(method.description);
    EXPECT_EQ(method.exact, method.key != "multi-level-sb");
  }
  for (const std::size_t different : {keys.size(), names.size(), summaries.size(), descriptions.size()})
    EXPECT_EQ(different, method_table().size());
}

TEST(Methods, StandByGroup) {
  std::vector<MethodGroup> groups;
  for (const Method& method : method_table()) {
    if (groups.empty() || groups.back() != method.group) groups.push_back(method.group);
  }
  groups.push_back(MethodGroup::guests);  // there are none at first
  EXPECT_TRUE(std::ranges::equal(groups, method_groups, {}, {}, &MethodGroupName::group));
}

void expect_that_the_table_grows() {
  const Method* first = method_table().data();
  for (std::size_t number = method_table().size(); number < max_methods; ++number) {
    Method row = *find_method(reference_method);
    row.key = "further-" + std::to_string(number);
    add_method(row);
    EXPECT_EQ(method_table().size(), number + 1);
    EXPECT_EQ(find_method(row.key), first + number) << "no row moves";
  }
  EXPECT_TRUE(method_keys().ends_with(", further-" + std::to_string(max_methods - 1)));
  Method row = *first;
  row.key = "one-too-many";
  EXPECT_THROW(add_method(row), std::length_error);
  EXPECT_EQ(find_method("one-too-many"), nullptr);
}

TEST(Methods, CanBeAddedWhileTheProgramRuns) { tests::in_a_process_of_its_own(expect_that_the_table_grows); }

/// Holds the words of the descriptions against the work after frames of other shapes, and of rest.
TEST(Methods, SayRightlyWhetherTheyKeepAnythingBetweenFrames) {
  const Ball ball = icosphere(2, 0.5f);
  const auto shape = std::make_shared<const Shape>(162, ball.edges, ball.vertices);
  State before, now;
  for (int body = 0; body < 6; ++body) {
    std::vector<glm::vec3> points = moved(ball.vertices, glm::vec3(0.7f * static_cast<float>(body), 0, 0));
    now.add(shape, points);
    for (glm::vec3& p : points) p = glm::vec3(0.8f * p.x - 0.6f * p.y, 0.6f * p.x + 0.8f * p.y, p.z);
    before.add(shape, points);
  }
  Settings settings = metre_cells();
  settings.tolerance = 0.08f;
  for (const Method& method : method_table()) {
    const auto says = [&](std::string_view words) { return method.description.find(words) != std::string_view::npos; };
    EXPECT_TRUE(says("Choose it ") && says("Cost: ") && (says("in every frame") || says("keeps nothing")))
        << method.key;
    const auto detector = method.make();
    Workers alone(1);
    Result result;
    detector->detect(before.frame(), settings, alone, result);
    for (int frame = 0; frame < 6; ++frame) detector->detect(now.frame(), settings, alone, result);
    const std::uint64_t fresh = detect(method.key, now, settings).counters.pair_tests;
    const bool keeps = says("once, ") || says("keep their contacts");
    EXPECT_EQ(result.counters.pair_tests != fresh, keeps) << method.key;
    detector->forget();
    detector->detect(now.frame(), settings, alone, result);
    EXPECT_EQ(result.counters.pair_tests, fresh) << method.key << " after forget()";
  }
}

/// Numbers of boxes, cells and entries that would need days or all memory if any of them were taken at its word.
TEST(Methods, TakeBoundedTimeForSettingsWithoutSense) {
  State state;
  std::mt19937 random(9);
  for (int body = 0; body < 30; ++body) {
    const float lo = uniform(random, 0, 3);
    state.add(random_points(random, 162, lo, lo + 1));
  }
  Settings settings{.tolerance = 0.02f};
  const std::vector<Contact> expected = oracle(state, settings);
  for (const Method& method : method_table()) {
    for (const float cell : {1e-30f, 1e-6f, 1e30f}) {
      for (const std::uint32_t buckets : {1u, max_buckets}) {
        settings.levels = max_levels;
        settings.buckets = buckets;
        settings.cell_size = glm::vec3(cell);
        const Result result = detect(method.key, state, settings, 2);
        if (!method.exact) continue;
        EXPECT_EQ(result.contacts, expected) << method.key << ' ' << cell << ' ' << buckets;
      }
    }
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
