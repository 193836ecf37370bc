// Input that asks for more than a detector may take.

#include <gtest/gtest.h>

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

TEST(BodyPairs, ThrowsBeyondItsLimit) {
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
