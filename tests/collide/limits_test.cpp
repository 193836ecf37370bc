// Input that asks for more than a detector may take.

#include <gtest/gtest.h>

#include <stdexcept>

#include "states.h"

namespace collide::test {
namespace {

/// 16,400 vertices in one place are more than 2^27 contacts.
TEST(Limits, TooManyContactsAreAnErrorAndTheNextFrameIsFound) {
  State crowd;
  crowd.add(std::vector<glm::vec3>(16'400, glm::vec3(0.5f)));
  const State settled = named_states()[1].make();
  Settings settings;
  settings.tolerance = settled.tolerance;
  Workers workers(2);
  // The rivals count in the same place as the literal method, and each takes a second and a gibibyte.
  for (const char* method : {"multi-level-sb", "multi-level-sb-exact"}) {
    const auto detector = find_method(method)->make();
    Result result;
    EXPECT_THROW(detector->detect(crowd.frame(), settings, workers, result), std::length_error) << method;
    detector->detect(settled.frame(), settings, workers, result);
    EXPECT_EQ(result.contacts, detect(method, settled, settings).contacts) << method;
  }
}

}  // namespace
}  // namespace collide::test
