// Compares the pairs of overlapping boxes with those of plain loops, with and without cuts, on every target.

#include "collide/surface/box_pairs.h"

#include <algorithm>
#include <random>

#include "every_target.h"

namespace collide::test {

using namespace collide::surface;
namespace THIS_FILE {

using Boxes = std::vector<Aabb>;

/// Items are numbered 5, 8, 11 ..., so that the number of an item is never its index in the list.
constexpr Index item_of(Index index) { return 5 + 3 * index; }

BoxList list_of(const Boxes& boxes) {
  BoxList list;
  list.reserve(static_cast<Index>(boxes.size()));
  for (Index k = 0; k < boxes.size(); ++k) list.add(boxes[k], item_of(k));
  list.end();
  return list;
}

bool overlap(const Aabb& a, const Aabb& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.hi[axis] < b.lo[axis] || b.hi[axis] < a.lo[axis]) return false;
  return true;
}

/// Appends the pairs of two lists that overlap, or of one list if both are the same.
void append_plain(const Boxes& a, const Boxes& b, std::vector<ItemPair>& pairs) {
  for (Index i = 0; i < a.size(); ++i)
    for (Index j = &a == &b ? i + 1 : 0; j < b.size(); ++j)
      if (overlap(a[i], b[j])) pairs.push_back({item_of(i), item_of(j)});
}

Boxes random_boxes(std::mt19937& random, std::size_t count, float space, float side) {
  Boxes boxes;
  for (const glm::vec3& lo : random_points(random, count, 0, space))
    boxes.push_back({lo, lo + random_points(random, 1, 0, side)[0]});
  return boxes;
}

/// Returns boxes with corners on a lattice: many boxes touch, and cuts pass through corners.
Boxes lattice_boxes(std::mt19937& random, std::size_t count, unsigned space) {
  Boxes boxes;
  const auto step = [&](unsigned n) { return static_cast<float>(random() % n); };
  for (std::size_t k = 0; k < count; ++k) {
    const glm::vec3 lo{step(space), step(space), step(space)};
    boxes.push_back({lo, lo + glm::vec3{step(3), step(3), step(3)}});
  }
  return boxes;
}

class BoxPairsTest : public OnEveryTarget {
 protected:
  /// Expects the pairs between two lists, and those within the first one appended to them. Returns how many there are.
  std::size_t expect_plain_pairs(const Boxes& a, const Boxes& b) {
    std::vector<ItemPair> pairs, expected;
    search_.between(list_of(a), list_of(b), pairs);
    search_.within(list_of(a), pairs);
    append_plain(a, b, expected);
    append_plain(a, a, expected);
    std::ranges::sort(pairs);
    std::ranges::sort(expected);
    EXPECT_EQ(pairs, expected);
    return pairs.size();
  }
  BoxPairs search_;
};

TEST_P(BoxPairsTest, FindsThePairsOfPlainLoopsWithoutCuts) {
  for (const std::size_t count : {0u, 1u, 2u, 15u, 16u, 17u, 63u, 64u, 65u, 200u}) {
    SCOPED_TRACE(count);
    expect_plain_pairs(random_boxes(random_, count, 1, 0.4f), random_boxes(random_, 70, 1, 0.4f));
  }
}

TEST_P(BoxPairsTest, FindsEachPairOnceWithCuts) {
  const std::size_t count = 1100;  // four times as many tests as a leaf takes
  static_assert(1100 * 1100 / 2 > 2 * BoxPairs::leaf_tests);
  for (const bool lattice : {false, true})
    for (const float space : {3.0f, 30.0f}) {
      const auto make = [&] {
        return lattice ? lattice_boxes(random_, count, static_cast<unsigned>(space) + 5)
                       : random_boxes(random_, count, space, 1);
      };
      EXPECT_GT(expect_plain_pairs(make(), make()), 20u) << lattice << ' ' << space;
    }
}

TEST_P(BoxPairsTest, FindsAllPairsOfBoxesThatNoCutSeparates) {
  Boxes points;  // without extent, half of them in one place
  for (const glm::vec3& p : random_points(random_, 400, 0, 1)) points.push_back({p, p});
  points.resize(800, points.back());
  const Boxes equal(800, Aabb{glm::vec3(-1), glm::vec3(2)});
  EXPECT_EQ(expect_plain_pairs(points, equal), 800u * 800 + 401 * 400 / 2);
}

TEST_P(BoxPairsTest, PickSelectsOverlappingBoxesInOrder) {
  BoxList picked;
  for (const std::size_t count : {300u, 40u, 0u}) {  // shrinks: earlier boxes must be gone
    const Boxes boxes = lattice_boxes(random_, count, 9);
    const Aabb window{glm::vec3(2), glm::vec3(5)};
    search_.pick(list_of(boxes), window, picked);
    std::vector<Index> expected;
    for (Index k = 0; k < boxes.size(); ++k)
      if (overlap(boxes[k], window)) expected.push_back(item_of(k));
    ASSERT_EQ(picked.size, expected.size());
    for (Index k = 0; k < picked.size; ++k) {
      EXPECT_EQ(picked.item[k], expected[k]);
      EXPECT_EQ(picked.box(k).lo, boxes[(expected[k] - 5) / 3].lo);
      EXPECT_EQ(picked.box(k).hi, boxes[(expected[k] - 5) / 3].hi);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, BoxPairsTest, testing::ValuesIn(targets()), target_name);

}  // namespace THIS_FILE
}  // namespace collide::test
