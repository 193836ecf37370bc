#include "collide/surface/box_tree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "states.h"

namespace collide::test {

using namespace collide::surface;
namespace THIS_FILE {

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

TEST(BoxTree, FindsTheNearestItemThatCounts) {
  std::mt19937 random(24);
  std::vector<Box> boxes = random_boxes(random, 200);
  for (std::size_t i = 0; i < 100; ++i) boxes.push_back(boxes[i]);  // equally near
  const BoxTree tree(boxes);
  for (const glm::vec3& point : random_points(random, 50, -1, 5))
    for (const Index step : {1u, 3u, 1000u}) {  // every item counts, every third one, and none
      int looks = 0;
      const auto distance = [&](Index item) {
        ++looks;
        const double squared = squared_distance_to(boxes[item], glm::dvec3(point));
        return item % step == step - 1 ? double{std::sqrt(float(squared))} : INFINITY;
      };
      BoxTree::Nearest expected{INFINITY, 0};
      for (Index i = 0; i < boxes.size(); ++i)
        if (distance(i) < expected.distance) expected = {distance(i), i};
      for (const Index guess : {0u, 299u}) {
        looks = 0;
        const BoxTree::Nearest found = tree.nearest(glm::dvec3(point), guess, distance);
        EXPECT_EQ(found.distance, expected.distance);
        EXPECT_TRUE(step == 1000 || (found.item == expected.item && looks < 150)) << looks;
      }
    }
}

/// Returns where a moving box is at a time.
Box at(const MovingBox& box, double time) {
  return {glm::mix(box.from.lo, box.to.lo, time), glm::mix(box.from.hi, box.to.hi, time)};
}

TEST(MovingBox, OverlapsNoBoxThatAnAxisSeparatesAtAllTimes) {
  std::mt19937 random(22);
  int separate = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::vector<Box> boxes = random_boxes(random, 4);
    const MovingBox a{boxes[0], boxes[1]}, b{boxes[2], boxes[3]};
    bool meet = false;
    for (const double time : {0.0, 0.25, 0.5, 0.75, 1.0}) meet = meet || overlap(at(a, time), at(b, time));
    EXPECT_TRUE(!meet || overlap(a, b));
    EXPECT_EQ(overlap(a, b), overlap(b, a));
    separate += !overlap(a, b);
  }
  EXPECT_GT(separate, 1000);
  const Box unit{glm::dvec3(0), glm::dvec3(1)}, beside{glm::dvec3(2, 0, 0), glm::dvec3(3, 1, 1)};
  const Box far{glm::dvec3(9), glm::dvec3(10)}, beside_far{glm::dvec3(11, 9, 9), glm::dvec3(12, 10, 10)};
  EXPECT_FALSE(overlap(MovingBox{unit, far}, {beside, beside_far})) << "they fly together";
  EXPECT_TRUE(overlap(MovingBox{unit, beside}, {beside, unit})) << "they change places";
}

TEST(MovingBoxTree, FindsExactlyTheOverlappingBoxes) {
  std::mt19937 random(23);
  const auto moving_boxes = [&](std::size_t count) {
    std::vector<MovingBox> boxes;
    for (std::size_t k = 0; k < count; ++k)
      boxes.push_back({random_boxes(random, 1).front(), random_boxes(random, 1).front()});
    return boxes;
  };
  const std::vector<MovingBox> boxes = moving_boxes(300);
  const MovingBoxTree tree(boxes);
  for (const MovingBox& query : moving_boxes(50)) {
    std::vector<Index> found, expected;
    tree.for_each_overlapping(query, [&](Index item) { found.push_back(item); });
    for (Index i = 0; i < boxes.size(); ++i) {
      if (overlap(boxes[i], query)) expected.push_back(i);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
