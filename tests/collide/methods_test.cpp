#include "collide/methods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "states.h"
#include "tests/own_process.h"

namespace collide::test {
namespace THIS_FILE {

TEST(Methods, AreThoseOfTheCommandLine) {
  EXPECT_EQ(method_keys(),
            "brute-force, grid-hash, bounding-box, bounding-box-grid-hash, multi-level-sb, multi-level-sb-complete, "
            "multi-level-sb-exact, sorted-grid, sweep-and-prune, aabb-tree, kd-tree, octree");
  EXPECT_NE(find_method(default_method), nullptr);
  EXPECT_EQ(find_method("nearly"), nullptr);
}

TEST(Methods, TellsThemApart) {
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
TEST(Methods, SayWhetherTheyKeepAnythingBetweenFrames) {
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

TEST(Methods, NamesBodiesThatAreNotFinite) {
  State state;
  state.add({glm::vec3(0), glm::vec3(0.05f, 0, 0)});
  state.add({glm::vec3(0), glm::vec3(0, NAN, 0)});
  state.add({});
  state.add({glm::vec3(0, 0.05f, 0)});
  state.add({glm::vec3(0, 0, -INFINITY)});
  for (const Method& method : method_table()) {
    const Result result = detect(method.key, state, metre_cells());
    EXPECT_EQ(result.non_finite_bodies, (std::vector<Index>{1, 4})) << method.key;
    EXPECT_EQ(result.contacts, (std::vector<Contact>{{0, 1}, {0, 4}, {1, 4}})) << method.key;
    EXPECT_EQ(result.self_contacts, 1u) << method.key;
  }
}

TEST(Methods, LeavesOutEdgesAndPairsNearAtRest) {
  const std::vector<glm::vec3> rest{glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(2, 0, 0), glm::vec3(2.05f, 0, 0)};
  const std::array<std::array<Index, 2>, 1> edges{{{0, 1}}};
  State state;
  state.add(std::make_shared<const Shape>(4, edges, rest), std::vector<glm::vec3>(4, glm::vec3(3)));
  for (const Method& method : method_table()) {
    EXPECT_EQ(detect(method.key, state, metre_cells()).contacts, (std::vector<Contact>{{0, 2}, {0, 3}, {1, 2}, {1, 3}}))
        << method.key;
  }
}

/// Frames in a row: bodies of one mesh bend, roll, jump far away and back, lose a coordinate, leave and come.
TEST(Methods, FollowASequenceWithJumps) {
  const Ball ball = icosphere(2, 0.5f);
  const auto shape = std::make_shared<const Shape>(162, ball.edges, ball.vertices);
  std::vector<std::unique_ptr<Detector>> one, two;
  for (const Method& method : method_table()) {
    one.push_back(method.make());
    two.push_back(method.make());
  }
  Workers alone(1), both(2, 0);
  Settings settings = metre_cells();
  settings.tolerance = 0.08f;
  std::mt19937 random(10);
  std::vector<glm::vec3> at = random_points(random, 7, -0.8f, 0.8f);
  std::size_t contacts = 0;
  for (int frame = 0; frame < 16; ++frame) {
    State state;
    for (std::size_t body = 0; body < at.size() - (frame % 6 == 5 ? 2 : 0); ++body) {
      std::vector<glm::vec3> points = ball.vertices;
      const float squeeze = body == 3 ? std::abs(std::cos(0.4f * static_cast<float>(frame))) : 1;
      for (glm::vec3& p : points) p.y *= squeeze;
      if (body == 4) std::rotate(points.begin(), points.begin() + frame, points.end());
      if (body == 2 && frame % 8 == 6) points[100].z = NAN;
      const bool away = body == 1 && frame % 4 >= 2;
      state.add(shape, moved(points, at[body] + (away ? glm::vec3(1e6f, 0, -1e6f) : glm::vec3(0))));
      if (frame % 5 != 4) at[body] += random_points(random, 1, -0.03f, 0.03f)[0];  // else all rest in the next frame
    }
    const std::vector<Contact> expected = oracle(state, settings);
    contacts += expected.size();
    for (std::size_t m = 0; m < method_table().size(); ++m) {
      if (!method_table()[m].exact) continue;
      Result on_one, on_two;
      one[m]->detect(state.frame(), settings, alone, on_one);
      two[m]->detect(state.frame(), settings, both, on_two);
      EXPECT_EQ(on_one.contacts, expected) << method_table()[m].key << ", frame " << frame;
      EXPECT_EQ(on_two.contacts, expected) << method_table()[m].key << ", frame " << frame;
      EXPECT_EQ(on_one.counters.pair_tests, on_two.counters.pair_tests) << method_table()[m].key;
    }
  }
  EXPECT_GT(contacts, 1000u);
}

/// Numbers of boxes, cells and entries that would need days or all memory if any of them were taken at its word.
TEST(Methods, AreBoundedForSettingsWithoutSense) {
  State state;
  std::mt19937 random(9);
  for (int body = 0; body < 30; ++body) {
    const float lo = uniform(random, 0, 3);
    state.add(random_points(random, 162, lo, lo + 1));
  }
  Settings settings;
  settings.tolerance = 0.02f;
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
