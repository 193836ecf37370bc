#pragma once
// Tests on each of Highway's targets that this machine has.

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <string>
#include <vector>

namespace tests {

inline std::vector<std::int64_t> targets() {
  std::vector<std::int64_t> targets;
  for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1)
    targets.push_back(left & -left);
  return targets;
}
inline std::string target_name(const testing::TestParamInfo<std::int64_t>& target) {
  return hwy::TargetName(target.param);
}

/// While it lives, loops use the instructions of this target.
class UseTarget {
 public:
  explicit UseTarget(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  UseTarget(const UseTarget&) = delete;
  UseTarget& operator=(const UseTarget&) = delete;
  ~UseTarget() { hwy::SetSupportedTargetsForTest(0); }
};

/// A test for each target, whose instructions it uses.
class OnEveryTarget : public testing::TestWithParam<std::int64_t> {
  UseTarget use_{GetParam()};
};

}  // namespace tests
