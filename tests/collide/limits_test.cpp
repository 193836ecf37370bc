// Input that asks for more than a detector may take.

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "collide/core/body_boxes.h"
#include "states.h"

namespace collide::test {
namespace THIS_FILE {

/// 16,400 vertices in one place are more than 2^27 contacts.
TEST(Limits, TooManyContactsAreAnErrorAndTheNextFrameIsFound) {
  State crowd;
  crowd.add(std::vector<glm::vec3>(16'400, glm::vec3(0.5f)));
  const State settled = named_states()[1].make();
  Settings settings = metre_cells();
  settings.tolerance = settled.tolerance;
  Workers workers(2, 0);
  // The rivals count in the same place as the literal method, and each takes a second and a gibibyte.
  for (const char* method : {"multi-level-sb", "multi-level-sb-exact"}) {
    const auto detector = find_method(method)->make();
    Result result;
    const auto see_settled = [&] {
      for (int frame = 0; frame < 6; ++frame) {  // enough for the contacts of bodies at rest to be kept
        detector->detect(settled.frame(), settings, workers, result);
        EXPECT_EQ(result.contacts, detect(method, settled, settings).contacts) << method;
      }
    };
    see_settled();
    EXPECT_THROW(detector->detect(crowd.frame(), settings, workers, result), std::length_error) << method;
    detector->debug();
    see_settled();
  }
}

/// As many pairs that a mesh has at rest are no contacts, and take no memory.
TEST(Limits, PairsThatAreCloseAtRestDoNotCount) {
  std::mt19937 random(27);
  const std::vector<glm::vec3> points = random_points(random, 16'400, -0.02f, 0.02f);
  State crowd;
  crowd.add(std::make_shared<const Shape>(Index{16'400}, std::span<const std::array<Index, 2>>{}, points), points);
  EXPECT_TRUE(detect("multi-level-sb-exact", crowd, {}).contacts.empty());
}

/// The true distance, which long double holds for all floats.
bool closer(const glm::vec3& a, const glm::vec3& b, float tolerance) {
  long double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const long double d = static_cast<long double>(a[axis]) - static_cast<long double>(b[axis]);
    sum += d * d;
  }
  return sum < static_cast<long double>(tolerance) * static_cast<long double>(tolerance);
}

/// Bodies of one vertex each: some in one place, some a hair more or less than the tolerance apart, some so near or far
/// that a square of their distance is no float.
State at_the_ends_of_floats(float tolerance) {
  State state;
  state.tolerance = tolerance;
  std::mt19937 random(13);
  for (const float place : {0.0f, 1e-45f, -1e-40f, 1e-30f, -1e-21f, 1e19f, -5e29f, 1e30f, 3.4e38f}) {
    const glm::vec3 centre(place, -place, 0);
    state.add({centre});
    state.add({centre});
    for (const float factor : {1e-5f, 0.9999f, 1.0001f, 1e5f}) {
      const glm::vec3 direction = random_points(random, 1, 0.2f, 1)[0];
      state.add({centre + direction * (tolerance * factor / std::hypot(direction.x, direction.y, direction.z))});
    }
  }
  return state;
}

TEST(Limits, ContactsAreThoseOfTrueDistances) {
  for (const float tolerance : {min_tolerance, 1e-9f, 1e9f, max_tolerance}) {
    const State state = at_the_ends_of_floats(tolerance);
    std::vector<Contact> expected;
    for (Index a = 0; a < state.x.size(); ++a)
      for (Index b = a + 1; b < state.x.size(); ++b)
        if (closer({state.x[a], state.y[a], state.z[a]}, {state.x[b], state.y[b], state.z[b]}, tolerance))
          expected.push_back({a, b});
    Settings settings = metre_cells();
    settings.tolerance = tolerance;
    ASSERT_EQ(problem(settings), "");
    for (const Method& method : method_table()) {
      if (!method.exact) continue;
      EXPECT_EQ(detect(method.key, state, settings).contacts, expected) << method.key << ", tolerance " << tolerance;
    }
  }
}

TEST(Limits, PairsOfNearBodies) {
  State crowd;
  for (int body = 0; body < 20; ++body) crowd.add({glm::vec3(0)});
  Result result;
  BodyBoxes boxes;
  boxes.build(crowd.frame(), result);
  BodyPairs pairs;
  EXPECT_EQ(pairs.find(boxes, 0.1f, 190).size(), 190u);
  EXPECT_THROW(pairs.find(boxes, 0.1f, 189), std::length_error);
}

}  // namespace THIS_FILE
}  // namespace collide::test
