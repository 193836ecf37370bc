#pragma once
// Runs a check in a process of its own, for what cannot be taken back: a table of the program that grows.

#include <cstdlib>

#include <gtest/gtest.h>

namespace tests {

inline void in_a_process_of_its_own(void (*check)()) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto run = [check] {
    check();
    std::exit(testing::Test::HasFailure() ? EXIT_FAILURE : EXIT_SUCCESS);
  };
  EXPECT_EXIT(run(), testing::ExitedWithCode(EXIT_SUCCESS), "");
}

}  // namespace tests
