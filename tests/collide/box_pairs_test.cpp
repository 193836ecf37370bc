// Compares the pairs of overlapping boxes with those of plain loops, with and without cuts, on every target.

#include "collide/surface/box_pairs.h"

#include <algorithm>
#include <random>

#include "collide/surface/pair_sort.h"
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

std::vector<ItemPair> plain_between(const Boxes& a, const Boxes& b) {
  std::vector<ItemPair> pairs;
  for (Index i = 0; i < a.size(); ++i)
    for (Index j = 0; j < b.size(); ++j)
      if (overlap(a[i], b[j])) pairs.push_back({item_of(i), item_of(j)});
  return pairs;
}

std::vector<ItemPair> plain_within(const Boxes& boxes) {
  std::vector<ItemPair> pairs;
  for (Index i = 0; i < boxes.size(); ++i)
    for (Index j = i + 1; j < boxes.size(); ++j)
      if (overlap(boxes[i], boxes[j])) pairs.push_back({item_of(i), item_of(j)});
  return pairs;
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

std::vector<ItemPair> sorted(std::vector<ItemPair> pairs) {
  std::ranges::sort(pairs);
  return pairs;
}

using BoxPairsTest = OnEveryTarget;

TEST_P(BoxPairsTest, FindsThePairsOfPlainLoopsWithoutCuts) {
  BoxPairs search;
  for (const std::size_t count : {0u, 1u, 2u, 15u, 16u, 17u, 63u, 64u, 65u, 200u}) {
    const Boxes a = random_boxes(random_, count, 1, 0.4f), b = random_boxes(random_, 70, 1, 0.4f);
    std::vector<ItemPair> pairs;
    search.between(list_of(a), list_of(b), pairs);
    EXPECT_EQ(sorted(pairs), plain_between(a, b)) << count;
    pairs.clear();
    search.within(list_of(a), pairs);
    EXPECT_EQ(sorted(pairs), plain_within(a)) << count;
  }
}

TEST_P(BoxPairsTest, FindsEachPairOnceWithCuts) {
  const std::size_t count = 1100;  // four times as many tests as a leaf takes
  static_assert(1100 * 1100 / 2 > 2 * BoxPairs::leaf_tests);
  BoxPairs search;
  for (const bool lattice : {false, true})
    for (const float space : {3.0f, 30.0f}) {
      const auto make = [&] {
        return lattice ? lattice_boxes(random_, count, static_cast<unsigned>(space) + 5)
                       : random_boxes(random_, count, space, 1);
      };
      const Boxes a = make(), b = make();
      std::vector<ItemPair> pairs;
      search.between(list_of(a), list_of(b), pairs);
      ASSERT_GT(pairs.size(), 10u);
      EXPECT_EQ(sorted(pairs), plain_between(a, b)) << lattice << ' ' << space;
      pairs.clear();
      search.within(list_of(a), pairs);
      ASSERT_GT(pairs.size(), 10u);
      EXPECT_EQ(sorted(pairs), plain_within(a)) << lattice << ' ' << space;
    }
}

TEST_P(BoxPairsTest, FindsAllPairsOfBoxesThatNoCutSeparates) {
  const Boxes equal(800, Aabb{glm::vec3(-1), glm::vec3(2)});  // all at one position
  BoxPairs search;
  std::vector<ItemPair> pairs;
  search.within(list_of(equal), pairs);
  EXPECT_EQ(sorted(pairs), plain_within(equal));
  Boxes points;  // without extent, half of them at one position
  for (const glm::vec3& p : random_points(random_, 400, 0, 1)) points.push_back({p, p});
  points.resize(800, points.back());
  pairs.clear();
  search.within(list_of(points), pairs);
  EXPECT_EQ(sorted(pairs), plain_within(points));
  EXPECT_EQ(pairs.size(), 401u * 400 / 2);
}

TEST_P(BoxPairsTest, AppendsPairsAndCountsTouchingBoxesAsOverlapping) {
  BoxPairs search;
  const ItemPair earlier{7, 3};
  std::vector<ItemPair> pairs{earlier};
  const Boxes one{{glm::vec3(0), glm::vec3(1)}}, touching{{glm::vec3(1), glm::vec3(2)}},
      apart{{glm::vec3(1.0001f, 0, 0), glm::vec3(2)}};
  search.between(list_of(one), list_of(apart), pairs);
  EXPECT_EQ(pairs, std::vector{earlier});
  search.between(list_of(one), list_of(touching), pairs);
  EXPECT_EQ(pairs, (std::vector<ItemPair>{earlier, {5, 5}})) << "boxes are closed";
}

TEST_P(BoxPairsTest, KeepsEarlierPairsInFrontOfThoseFromCuts) {
  BoxPairs search;
  const Boxes a = random_boxes(random_, 1100, 3, 1), b = random_boxes(random_, 1100, 3, 1);
  const std::vector<ItemPair> earlier{{1u << 30, 3}, {1u << 29, 4}};
  for (const bool one : {false, true}) {
    std::vector<ItemPair> pairs = earlier, expected = earlier, found = one ? plain_within(a) : plain_between(a, b);
    one ? search.within(list_of(a), pairs) : search.between(list_of(a), list_of(b), pairs);
    expected.insert(expected.end(), found.begin(), found.end());
    std::sort(pairs.begin() + std::ssize(earlier), pairs.end());
    EXPECT_EQ(pairs, expected) << one;
  }
}

TEST_P(BoxPairsTest, PickSelectsOverlappingBoxesInOrder) {
  BoxPairs search;
  BoxList picked;
  for (const std::size_t count : {300u, 40u, 0u}) {  // shrinks: earlier boxes must be gone
    const Boxes boxes = lattice_boxes(random_, count, 9);
    const Aabb window{glm::vec3(2), glm::vec3(5)};
    search.pick(list_of(boxes), window, picked);
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

TEST(PairSort, SortsAsComparisonsDo) {
  std::mt19937 random(5);
  PairSort sort;
  for (const std::size_t count : {0u, 1u, 2u, 500u}) {
    std::vector<ItemPair> pairs;
    for (std::size_t i = 0; i < count; ++i) pairs.push_back({Index(random() % 40), Index(random() % 7)});
    std::vector<ItemPair> expected = pairs;
    std::sort(expected.begin(), expected.end());
    sort.sort(pairs, 40, 7);
    EXPECT_EQ(pairs, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, BoxPairsTest, testing::ValuesIn(targets()), target_name);

}  // namespace THIS_FILE
}  // namespace collide::test
