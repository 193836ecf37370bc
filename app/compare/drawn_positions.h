#pragma once
// Where vertices are drawn: in slow motion between two steps.

#include <glm/common.hpp>

#include "app/compare/positions.h"

namespace app {

/// `part` of the way from `before` to `now`. Vertices beyond `before` are where they are. Owns nothing.
struct DrawnPositions {
  collide::Frame now{};
  std::span<const float> x{}, y{}, z{};  // before
  float part = 1;

  std::size_t size() const { return now.x.size(); }
  glm::vec3 operator[](std::size_t i) const {
    const glm::vec3 here(now.x[i], now.y[i], now.z[i]);
    if (part >= 1 || i >= x.size()) return here;
    return glm::mix(glm::vec3(x[i], y[i], z[i]), here, part);
  }
};

}  // namespace app
