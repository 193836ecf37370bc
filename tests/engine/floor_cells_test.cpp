#include "engine/render/floor_cells.h"

#include <gtest/gtest.h>

#include <array>

namespace {

using engine::FloorCells;

constexpr FloorCells::Place floor_place{glm::vec2(0.0f), 10.0f, 0.0f};
const glm::vec3 from_above(0.0f, 1.0f, 0.0f), from_the_side(1.0f, 1.0f, 0.0f);

bool shadowed_at(const FloorCells& cells, glm::vec2 place) {
  const engine::FloorArea& all = cells.shadowed();
  const glm::vec2 at = (place - all.lo) / (all.hi - all.lo) * static_cast<float>(FloorCells::side);
  const auto column = static_cast<int>(at.x), row = static_cast<int>(at.y);
  const bool inside = at.x >= 0 && at.y >= 0 && column < FloorCells::side && row < FloorCells::side;
  return inside && cells.shadowed(column, row);
}

TEST(FloorCells, AreNowhereWithoutSpheres) {
  FloorCells cells;
  cells.update({}, floor_place, from_above, 0.1f);
  EXPECT_TRUE(cells.shaded().empty());
  EXPECT_TRUE(cells.shadowed().empty());
}

TEST(FloorCells, HoldTheShadowsOfAllSpheres) {
  FloorCells cells;
  const std::array spheres{glm::vec4(-4.0f, 1.0f, 0.0f, 0.5f), glm::vec4(4.0f, 2.0f, 3.0f, 0.5f)};
  cells.update(spheres, floor_place, from_the_side, 0.1f);
  for (const glm::vec2 centre : {glm::vec2(-5.0f, 0.0f), glm::vec2(2.0f, 3.0f)}) {
    for (const float x : {-0.8f, 0.0f, 0.8f}) {  // a shadow of 0.5 m, drawn out along x, and 0.1 m
      for (const float z : {-0.59f, 0.0f, 0.59f}) EXPECT_TRUE(shadowed_at(cells, centre + glm::vec2(x, z)));
    }
  }
  EXPECT_FALSE(shadowed_at(cells, {-1.5f, 0.0f}));
  EXPECT_LE(cells.shaded().lo.x, -6.0f);
  EXPECT_GE(cells.shaded().hi.x, 6.0f);
}

TEST(FloorCells, StayWithinTheFloorHoweverFarASphereFlies) {
  FloorCells cells;
  const std::array spheres{glm::vec4(1e30f, 1.0f, 0.0f, 0.5f), glm::vec4(0.0f, 1.0f, 0.0f, 0.5f)};
  cells.update(spheres, floor_place, from_above, 0.1f);
  EXPECT_FLOAT_EQ(cells.shadowed().hi.x, 0.6f);
  EXPECT_LE(cells.shaded().hi.x, 10.0f);
}

TEST(FloorCells, LeaveOutWhatIsTooHighToHideTheSkyAndWhatIsBelow) {
  FloorCells cells;
  cells.update(std::array{glm::vec4(0.0f, 5.0f, 0.0f, 0.5f)}, floor_place, from_above, 0.1f);
  EXPECT_TRUE(cells.shaded().empty());
  EXPECT_TRUE(shadowed_at(cells, {0.0f, 0.0f}));
  cells.update(std::array{glm::vec4(0.0f, -5.0f, 0.0f, 0.5f)}, floor_place, from_above, 0.1f);
  EXPECT_TRUE(cells.shadowed().empty());
}

}  // namespace
