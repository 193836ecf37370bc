#pragma once
// Runs a check in a process of its own, for what cannot be taken back: a table of the program that grows.

#include <cstdlib>
#include <iostream>

#include <gtest/gtest.h>

namespace tests {

inline void in_a_process_of_its_own(void (*check)()) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto run = [check] {
    check();
    const testing::TestResult& result = *testing::UnitTest::GetInstance()->current_test_info()->result();
    for (int i = 0; i < result.total_part_count(); ++i) std::cerr << result.GetTestPartResult(i).message() << '\n';
    std::exit(testing::Test::HasFailure() ? EXIT_FAILURE : EXIT_SUCCESS);
  };
  EXPECT_EXIT(run(), testing::ExitedWithCode(EXIT_SUCCESS), "");
}

}  // namespace tests
