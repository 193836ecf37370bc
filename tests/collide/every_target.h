#pragma once
// What the tests of the vector loops share: every target that this machine has, and points as runs.

#include <cmath>
#include <limits>

#include "collide/core/vertex_run.h"
#include "states.h"
#include "tests/every_target.h"

namespace collide::test {

inline constexpr float nan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr std::array<Index, 12> sizes{1, 2, 3, 4, 5, 7, 8, 15, 16, 17, 64, 101};

struct Points3 {
  std::vector<float> x, y, z;
  explicit Points3(const std::vector<glm::vec3>& points) {
    for (const glm::vec3& p : points) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  }
  VertexRun run() const { return {x.data(), y.data(), z.data(), static_cast<Index>(x.size())}; }
};

class OnEveryTarget : public tests::OnEveryTarget {
 protected:
  std::mt19937 random_{41};
};

using tests::target_name, tests::targets;

}  // namespace collide::test
