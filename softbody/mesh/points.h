#pragma once
// Positions as detectors take them: one array for each coordinate.

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace softbody {

/// Positions (m) that others keep.
struct ConstPoints {
  std::span<const float> x, y, z;
  glm::vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// Positions (m).
struct Points {
  std::vector<float> x, y, z;
  void add(std::span<const glm::dvec3> points) {
    for (const glm::dvec3& p : points)
      x.push_back(static_cast<float>(p.x)), y.push_back(static_cast<float>(p.y)), z.push_back(static_cast<float>(p.z));
  }
  operator ConstPoints() const { return {x, y, z}; }
};

}  // namespace softbody
