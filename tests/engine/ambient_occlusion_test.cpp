#include "engine/render/ambient_occlusion.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <set>

namespace engine::render {
namespace THIS_FILE {

TEST(MeanSphere, HoldsTheVerticesAndIsZeroWithoutThemOrIfOneIsNotFinite) {
  std::vector<glm::vec3> octahedron{{3, 0, 0}, {-1, 0, 0}, {1, 2, 0}, {1, -2, 0}, {1, 0, 2}, {1, 0, -2}};
  EXPECT_EQ(mean_sphere(octahedron), glm::vec4(1, 0, 0, 2));
  EXPECT_EQ(mean_sphere({}), glm::vec4(0.0f));
  octahedron[4].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(mean_sphere(octahedron), glm::vec4(0.0f));
}

TEST(AmbientOcclusion, TouchingSpheresOccludeEachOtherAndDistantOnesDoNot) {
  FrameData frame;
  frame.spheres = {{{0, 0, 0}, 1.0f}, {{2, 0, 0}, 1.0f}, {{0, 3.4f, 0}, 1.0f}, {{50, 0, 0}, 1.0f}};
  AmbientOcclusion occlusion;
  occlusion.update(frame);
  ASSERT_EQ(occlusion.ranges().size(), 4u);
  EXPECT_EQ(occlusion.ranges()[0].count, 1u);
  EXPECT_EQ(occlusion.occluders()[occlusion.ranges()[0].first], glm::vec4(2, 0, 0, 1));
  EXPECT_EQ(occlusion.occluders()[occlusion.ranges()[1].first], glm::vec4(0, 0, 0, 1));
  for (const std::size_t distant : {2, 3}) EXPECT_EQ(occlusion.ranges()[distant].count, 0u);
}

TEST(AmbientOcclusion, SweepMissesNoOccluderOfAnySize) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(-4.0f, 4.0f), radius(0.05f, 1.5f);
  FrameData frame;
  for (int i = 0; i < 120; ++i)
    frame.spheres.push_back({{coordinate(random), coordinate(random), coordinate(random)}, radius(random)});
  AmbientOcclusion occlusion;
  occlusion.update(frame);
  for (std::size_t i = 0; i < frame.spheres.size(); ++i) {
    const OccluderRange range = occlusion.ranges()[i];
    std::multiset<float> found;
    for (const glm::vec4& sphere : occlusion.occluders().subspan(range.first, range.count)) found.insert(sphere.x);
    for (std::size_t j = 0; j < frame.spheres.size(); ++j) {
      const Sphere &a = frame.spheres[i], &b = frame.spheres[j];
      // A sphere occludes another if its centre is within 2.2 of its radii of the surface of the other.
      if (i == j || glm::distance(a.centre, b.centre) >= a.radius + 2.2f * b.radius) continue;
      EXPECT_EQ(found.count(b.centre.x), 1u) << i << " " << j;
    }
  }
}

}  // namespace THIS_FILE
}  // namespace engine::render
