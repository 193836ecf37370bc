#include "collide/surface/box_tree.h"

#include <gtest/gtest.h>

#include "states.h"

namespace collide::test {

using namespace collide::surface;
namespace {

std::vector<Box> random_boxes(std::mt19937& random, std::size_t count) {
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    box.add(glm::dvec3(random_points(random, 1, 0, 4)[0]));
    box.add(box.lo + glm::dvec3(random_points(random, 1, 0, 0.7f)[0]));
  }
  return boxes;
}

TEST(BoxTree, FindsExactlyTheOverlappingBoxes) {
  std::mt19937 random(21);
  for (const std::size_t count : {0u, 1u, 2u, 3u, 200u}) {
    std::vector<Box> boxes = random_boxes(random, count);
    if (count > 2) boxes[1] = {};
    const BoxTree tree(boxes);
    for (const Box& query : random_boxes(random, 50)) {
      std::vector<Index> found, expected;
      tree.for_each_overlapping(query, [&](Index item) { found.push_back(item); });
      for (Index i = 0; i < count; ++i) {
        if (overlap(boxes[i], query)) expected.push_back(i);
      }
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(BoxTree, FindsEqualBoxesAndBoxesThatOnlyTouch) {
  const Box unit{glm::dvec3(0), glm::dvec3(1)};
  const BoxTree tree(std::vector<Box>(9, unit));
  const auto found = [&](const Box& query) {
    int count = 0;
    tree.for_each_overlapping(query, [&](Index) { ++count; });
    return count;
  };
  EXPECT_EQ(found(unit), 9);
  EXPECT_EQ(found({glm::dvec3(1), glm::dvec3(2)}), 9);
  EXPECT_EQ(found({glm::dvec3(1, 1, 1.0000001), glm::dvec3(2)}), 0);
  EXPECT_EQ(found({}), 0);
}

}  // namespace
}  // namespace collide::test
