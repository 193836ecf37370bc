#include "engine/render/floor_regions.h"

#include <gtest/gtest.h>

#include <array>

namespace THIS_FILE {

using engine::render::FloorRegions;

constexpr FloorRegions::Floor test_floor{glm::vec2(0.0f), 10.0f, 0.0f};
const glm::vec3 from_above(0.0f, 1.0f, 0.0f), slanting(1.0f, 1.0f, 0.0f);

bool shadowed_at(const FloorRegions& regions, glm::vec2 point) {
  const engine::render::FloorRect& all = regions.shadowed();
  const glm::vec2 at = (point - all.lo) / (all.hi - all.lo) * static_cast<float>(FloorRegions::cells_per_side);
  const auto column = static_cast<int>(at.x), row = static_cast<int>(at.y);
  const bool inside =
      at.x >= 0 && at.y >= 0 && column < FloorRegions::cells_per_side && row < FloorRegions::cells_per_side;
  return inside && regions.is_shadowed(column, row);
}

TEST(FloorRegions, ContainTheShadowsOfAllSpheres) {
  FloorRegions regions;
  const std::array spheres{glm::vec4(-4.0f, 1.0f, 0.0f, 0.5f), glm::vec4(4.0f, 2.0f, 3.0f, 0.5f)};
  regions.update(spheres, test_floor, slanting, 0.1f);
  for (const glm::vec2 centre : {glm::vec2(-5.0f, 0.0f), glm::vec2(2.0f, 3.0f)}) {
    for (const float x : {-0.8f, 0.0f, 0.8f}) {  // radius 0.5 m, stretched along x, plus 0.1 m
      for (const float z : {-0.59f, 0.0f, 0.59f}) EXPECT_TRUE(shadowed_at(regions, centre + glm::vec2(x, z)));
    }
  }
  EXPECT_FALSE(shadowed_at(regions, {-1.5f, 0.0f}));
  EXPECT_LE(regions.occluded().lo.x, -6.0f);
  EXPECT_GE(regions.occluded().hi.x, 6.0f);
}

TEST(FloorRegions, StayWithinTheFloorIfASphereIsFarAway) {
  FloorRegions regions;
  const std::array spheres{glm::vec4(1e30f, 1.0f, 0.0f, 0.5f), glm::vec4(0.0f, 1.0f, 0.0f, 0.5f)};
  regions.update(spheres, test_floor, from_above, 0.1f);
  EXPECT_FLOAT_EQ(regions.shadowed().hi.x, 0.6f);
  EXPECT_LE(regions.occluded().hi.x, 10.0f);
}

TEST(FloorRegions, OmitSpheresThatAreTooHighOrBelowTheFloor) {
  FloorRegions regions;
  regions.update({}, test_floor, from_above, 0.1f);
  EXPECT_TRUE(regions.occluded().empty() && regions.shadowed().empty());
  regions.update(std::array{glm::vec4(0.0f, 5.0f, 0.0f, 0.5f)}, test_floor, from_above, 0.1f);
  EXPECT_TRUE(regions.occluded().empty());
  EXPECT_TRUE(shadowed_at(regions, {0.0f, 0.0f}));
  regions.update(std::array{glm::vec4(0.0f, -5.0f, 0.0f, 0.5f)}, test_floor, from_above, 0.1f);
  EXPECT_TRUE(regions.shadowed().empty());
}

}  // namespace THIS_FILE
