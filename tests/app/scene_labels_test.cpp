#include "app/ui/views/scene_labels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/render/miss_marks.h"
#include "app/session/session.h"
#include "softbody/world/world.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

using Places = std::vector<std::optional<ui::ScreenRect>>;

const ui::ScreenRect area{{100, 50}, {500, 350}};
const ImVec2 text_size{60, 16};

void expect_apart(const Places& places) {
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (places[i] && places[j]) {
        EXPECT_FALSE(overlap(*places[i], *places[j])) << i << " and " << j;
      }
}

TEST(PlaceTexts, KeepsTextsInTheAreaAndApart) {
  std::vector<ui::LabelOnScreen> labels;
  for (const float x : {101.0f, 110.0f, 250.0f, 255.0f, 499.0f})
    for (const float y : {51.0f, 200.0f, 349.0f}) labels.push_back({{x, y}, text_size});
  const Places places = ui::place_texts(labels, area, 1);
  expect_apart(places);
  for (const auto& place : places) {
    ASSERT_TRUE(place);
    EXPECT_GE(place->min.x, area.min.x);
    EXPECT_GE(place->min.y, area.min.y);
    EXPECT_LE(place->max.x, area.max.x);
    EXPECT_LE(place->max.y, area.max.y);
  }
}

TEST(PlaceTexts, LeavesOutTextsWithoutAFreePlace) {
  const std::vector<ui::LabelOnScreen> labels(40, {{300, 200}, text_size});
  const Places places = ui::place_texts(labels, area, 1);
  expect_apart(places);
  EXPECT_TRUE(places.front());
  EXPECT_FALSE(places.back());
  EXPECT_FALSE(ui::place_texts(std::vector<ui::LabelOnScreen>{{{600, 200}, text_size}}, area, 1)[0])
      << "its point is outside";
}

TEST(PlaceTexts, KeepsTextsOffTheMiddleOfAllRings) {
  std::vector<ui::LabelOnScreen> labels;
  for (const float x : {250.0f, 270.0f, 300.0f, 330.0f}) labels.push_back({{x, 200 - 0.1f * x}, text_size, 15});
  const Places places = ui::place_texts(labels, area, 1);
  expect_apart(places);
  for (const auto& place : places)
    for (const ui::LabelOnScreen& label : labels)
      if (place) {
        EXPECT_FALSE(
            overlap(*place, {{label.point.x - 10, label.point.y - 10}, {label.point.x + 10, label.point.y + 10}}));
      }
}

TEST(MissMarks, GroupMissedContactsByPairAndNearness) {
  const softbody::World world(touching_pair(), {});
  const render::DrawnPositions positions{.now = world.positions()};
  const collide::Index second = world.bodies().first[1], end = world.bodies().vertex_count();
  const auto by_x = [&](collide::Index a, collide::Index b) { return positions[a].x < positions[b].x; };
  std::vector<collide::Index> left, right;
  for (collide::Index v = 0; v < second; ++v) left.push_back(v);
  for (collide::Index v = second; v < end; ++v) right.push_back(v);
  std::ranges::sort(left, by_x);
  std::ranges::sort(right, by_x);
  const collide::Index innermost = left.back(), outermost = left.front();
  // Three contacts between the bodies, and one on the far side of the left one.
  const std::vector<collide::Contact> missed{
      {innermost, right[0]}, {innermost, right[1]}, {left[left.size() - 2], right[0]}, {outermost, left[1]}};
  const std::vector<render::SceneLabel> marks = render::miss_marks(world, missed, positions);
  ASSERT_EQ(marks.size(), 2u);
  EXPECT_EQ(marks[0].text, "3 missed");
  EXPECT_EQ(marks[1].text, "1 missed");
  EXPECT_LT(std::abs(marks[0].at.x), 0.15f) << "between the bodies";
  EXPECT_LT(marks[1].at.x, -0.8f);
  for (const render::SceneLabel& mark : marks) EXPECT_TRUE(mark.ring);
  EXPECT_TRUE(render::miss_marks(world, {}, positions).empty());
}

}  // namespace THIS_FILE
}  // namespace app
