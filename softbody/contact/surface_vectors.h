#pragma once
// Directions, as contacts of surfaces want them.

#include <glm/geometric.hpp>

namespace softbody {

inline glm::vec3 normal_of(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return glm::cross(b - a, c - a);
}

/// Returns the unit vector along v, or along `otherwise` if v has no length to speak of.
inline glm::vec3 unit(const glm::vec3& v, const glm::vec3& otherwise) {
  const float length = glm::length(v);
  if (length > 1e-9f) return v / length;
  const float other = glm::length(otherwise);
  return other > 0 ? otherwise / other : glm::vec3(0, 1, 0);
}

}  // namespace softbody
