// The tree against all pairs, at every level.

#include "collide/exact/overlap_tree.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "collide/core/cutoff.h"
#include "every_target.h"

namespace collide::test {

using namespace collide::exact;
namespace THIS_FILE {

constexpr std::size_t no_limit = std::size_t{1} << 22;

VertexSet picked(const std::vector<glm::vec3>& points, Index first) {
  VertexSet set;
  set.reserve(static_cast<Index>(points.size()));
  for (const glm::vec3& p : points) set.add(p.x, p.y, p.z, first++);
  set.end();
  return set;
}

std::vector<Contact> sorted(std::vector<Contact> contacts) {
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

std::vector<Contact> between(const VertexSet& a, const VertexSet& b, float tolerance2) {
  std::vector<Contact> contacts;
  for (Index i = 0; i < a.size; ++i) {
    for (Index j = 0; j < b.size; ++j) {
      if (squared_distance(a.x[i], a.y[i], a.z[i], b.x[j], b.y[j], b.z[j]) < tolerance2) {
        contacts.push_back({a.vertex[i], b.vertex[j]});
      }
    }
  }
  return contacts;
}

/// Pairs of sets: mixed, side by side, far apart, on a lattice where distances equal the tolerance, all in one place.
struct Sets {
  std::vector<glm::vec3> a, b;
  float tolerance;
};
std::vector<Sets> examples() {
  std::mt19937 random(71);
  std::vector<Sets> sets;
  sets.push_back({random_points(random, 300, 0, 1), random_points(random, 250, 0, 1), 0.05f});
  sets.push_back(
      {random_points(random, 300, 0, 1), moved(random_points(random, 250, 0, 1), glm::vec3(0.9f, 0, 0.3f)), 0.1f});
  sets.push_back({random_points(random, 200, 0, 1), moved(random_points(random, 200, 0, 1), glm::vec3(9)), 0.1f});
  sets.push_back({std::vector<glm::vec3>(200, glm::vec3(1)), std::vector<glm::vec3>(150, glm::vec3(1)), 0.1f});
  std::vector<glm::vec3> lattice;
  for (int i = 0; i < 512; ++i) lattice.push_back(glm::vec3(i % 8, i / 8 % 8, i / 64));
  sets.push_back({lattice, moved(lattice, glm::vec3(0, 4, 0)), 1.0f});
  sets.push_back({lattice, moved(lattice, glm::vec3(8, 0, 0)), std::nextafter(1.0f, 2.0f)});
  std::vector<glm::vec3> odd;  // the midpoint of all of it is one of its planes
  for (int i = 0; i < 729; ++i) odd.push_back(glm::vec3(i % 9, i / 9 % 9, i / 81));
  sets.push_back({{odd.begin(), odd.begin() + 400}, {odd.begin() + 400, odd.end()}, std::nextafter(1.0f, 2.0f)});
  return sets;
}

class OverlapTreeOnTargets : public OnEveryTarget {};

TEST_P(OverlapTreeOnTargets, BetweenTwoSetsFindsAllPairsOnceAtEveryLevel) {
  const std::vector<Sets> all = examples();
  for (const Sets& sets : all) {
    const VertexSet a = picked(sets.a, 5), b = picked(sets.b, 9000);
    const float tolerance2 = sets.tolerance * sets.tolerance;
    const std::vector<Contact> expected = between(a, b, tolerance2);
    const Aabb around = box_around(0, sets.a.size(), [&](std::size_t k) { return sets.a[k]; });
    std::uint64_t uncut = 0;
    for (int levels = 0; levels <= max_levels; ++levels) {
      OverlapTree tree;
      tree.begin(levels, contact_cutoff(sets.tolerance), tolerance2, no_limit);
      std::vector<Contact> contacts;
      tree.between(a, b, 3, contacts);
      if (tree.leaves() == 0) {
        EXPECT_TRUE(std::is_sorted(contacts.begin(), contacts.end()));
      }
      ASSERT_EQ(sorted(contacts), expected) << levels;
      if (levels == 0) {
        uncut = tree.pair_tests();
        EXPECT_EQ(uncut, std::uint64_t{a.size} * b.size);
      }
      const bool is_cut = &sets == &all.front() && levels == 6;
      EXPECT_LE(tree.pair_tests(), is_cut ? uncut / 2 : uncut);
      EXPECT_TRUE(!is_cut || !tree.leaf_boxes().empty());
      for (const auto& leaf : tree.leaf_boxes()) {
        EXPECT_EQ(leaf.body, 3u);
        EXPECT_EQ(glm::min(leaf.lo, leaf.hi), leaf.lo);
        EXPECT_EQ(joint(around, {leaf.lo, leaf.hi}), around) << "inside the box of the first set";
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, OverlapTreeOnTargets, testing::ValuesIn(targets()), target_name);

/// However few levels are asked for: else a large body would cost the square of its vertices.
TEST(OverlapTree, CutsLargeSetsUntilTheirCostIsLinear) {
  std::mt19937 random(72);
  constexpr float tolerance = 0.02f;
  std::uint64_t before = 0;
  for (const int count : {4'000, 16'000, 64'000}) {
    const float side = std::sqrt(static_cast<float>(count)) * tolerance;
    std::vector<glm::vec3> sheet = random_points(random, static_cast<Index>(count), 0, side);
    for (glm::vec3& p : sheet) p.z = 0;
    const VertexSet set = picked(sheet, 0), above = picked(moved(sheet, glm::vec3(0, 0, tolerance / 2)), 100'000);
    std::vector<Contact> contacts;
    OverlapTree tree;
    tree.begin(0, contact_cutoff(tolerance), tolerance * tolerance, no_limit);
    tree.between(set, above, 0, contacts);
    if (before > 0) {
      EXPECT_LT(tree.pair_tests(), 6 * before) << count;
    } else {
      EXPECT_EQ(sorted(contacts), between(set, above, tolerance * tolerance));
    }
    before = tree.pair_tests();
  }
}

TEST(OverlapTree, ThrowsBeyondItsLimit) {
  const VertexSet a = picked(std::vector<glm::vec3>(200, glm::vec3(1)), 0),
                  b = picked(std::vector<glm::vec3>(200, glm::vec3(1)), 200);
  for (const int levels : {0, 4}) {
    OverlapTree tree;
    std::vector<Contact> contacts;
    tree.begin(levels, 0.1f, 0.01f, 40'000);
    tree.between(a, b, 0, contacts);
    EXPECT_EQ(contacts.size(), 40'000u);
    contacts.resize(1);
    EXPECT_THROW(tree.between(a, b, 0, contacts), std::length_error);
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
