#include "engine/run_loop.h"

#include <gtest/gtest.h>

namespace engine {
namespace THIS_FILE {

TEST(RunLoop, CallsTheTurnUntilItReturnsFalse) {
  int turns = 0;
  run_loop([&] { return ++turns < 3; });
  EXPECT_EQ(turns, 3);
}

}  // namespace THIS_FILE
}  // namespace engine
