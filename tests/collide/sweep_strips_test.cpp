// The sweep over boxes against plain scalar code, on every target.

#include "collide/exact/sweep_strips.h"

#include "collide/core/aabb.h"
#include "collide/core/cutoff.h"
#include "every_target.h"

namespace collide::test {

using namespace collide::exact;
namespace THIS_FILE {

using StripKernel = OnEveryTarget;

TEST_P(StripKernel, BoxesAreThoseOfPlainLoops) {
  for (const Index size : sizes) {
    for (int trial = 0; trial < 3; ++trial) {
      SweepStrips boxes;
      boxes.resize(size);
      std::vector<Aabb> all;
      for (const glm::vec3& lo : random_points(random_, size, 0, 3)) {
        all.push_back({lo, lo + random_points(random_, 1, 0.1f, 1)[0]});
      }
      const auto centre = [&](Index i) { return all[i].lo * 0.5f + all[i].hi * 0.5f; };
      const auto radius = [&](Index i) { return 0.4f * (all[i].hi.x - all[i].lo.x); };
      for (Index i = 0; i < size; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          boxes.lo[axis][i] = all[i].lo[static_cast<int>(axis)];
          boxes.hi[axis][i] = all[i].hi[static_cast<int>(axis)];
          boxes.centre[axis][i] = centre(i)[static_cast<int>(axis)];
        }
        boxes.radius[i] = radius(i);
      }
      const float cutoff = 0.2f;
      for (Index i = 0; i < size; ++i) {
        const Index begin = random_() % (size + 1), end = begin + random_() % (size + 1 - begin);
        std::vector<Index> expected, found{77};
        Index near_box_pairs = 0;
        for (Index j = begin; j < end; ++j) {
          if (!near(all[i], all[j], cutoff)) continue;
          ++near_box_pairs;
          const glm::vec3 d = centre(j) - centre(i);
          const float reached = radius(i) + radius(j) + cutoff;
          if (d.x * d.x + d.y * d.y + d.z * d.z <= reached * reached * 1.000003f) expected.push_back(j);
        }
        expected.insert(expected.begin(), 77);
        EXPECT_EQ(sweep_strip(boxes, i, begin, end, cutoff, found), near_box_pairs);
        EXPECT_EQ(found, expected);
      }
    }
  }
}

TEST_P(StripKernel, LosesNoSpheresThatJustTouchToRounding) {
  constexpr float cutoff = 0.2f;
  for (int trial = 0; trial < 100; ++trial) {
    SweepStrips boxes;
    boxes.resize(2);
    const std::vector<glm::vec3> centre = random_points(random_, 2, -3, 3);
    const glm::dvec3 d = glm::dvec3(centre[1]) - glm::dvec3(centre[0]);
    const double apart = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    if (apart < 1) continue;
    for (Index i = 0; i < 2; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float at = centre[i][static_cast<int>(axis)];
        boxes.lo[axis][i] = at - 3, boxes.centre[axis][i] = at, boxes.hi[axis][i] = at + 3;
      }
      boxes.radius[i] = round_up((apart - double{cutoff}) / 2);
    }
    std::vector<Index> found;
    sweep_strip(boxes, 0, 1, 2, cutoff, found);
    ASSERT_EQ(found, std::vector<Index>{1}) << trial;
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, StripKernel, testing::ValuesIn(targets()), target_name);

}  // namespace THIS_FILE
}  // namespace collide::test
