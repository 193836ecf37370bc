#pragma once
// What the stages of surface contact share: velocities and directions.

#include <limits>

#include <glm/geometric.hpp>

#include "softbody/contact/surface_contact.h"

namespace softbody {

/// ContactRow::feature of a row that nothing is remembered of.
inline constexpr std::uint32_t uncached = std::numeric_limits<std::uint32_t>::max();

inline glm::vec3 normal_of(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return glm::cross(b - a, c - a);
}

/// Of the two closest points. Bodies that do not move stand, whatever velocity they will set out with.
inline glm::vec3 relative_velocity(const ContactRow& row, Field<const float> v) {
  glm::vec3 velocity(0.0f);
  for (std::size_t k = 0; k < 4; ++k)
    if (row.mobility[k] != 0) velocity += row.weight[k] * read(v, row.slot[k]);
  return velocity;
}

/// Changes the velocities so that one row meets its target and friction its cone, and adds to the row's impulses: one
/// step of projected Gauss-Seidel. Returns the energy (J) that the row's whole impulse gives by pushing apart: an
/// impact gets no more back than it had.
float solve_row(ContactRow& row, Field<float> v);

/// v, or `otherwise` if it has no length to speak of; of unit length.
inline glm::vec3 unit(const glm::vec3& v, const glm::vec3& otherwise) {
  const float length = glm::length(v);
  if (length > 1e-9f) return v / length;
  const float other = glm::length(otherwise);
  return other > 0 ? otherwise / other : glm::vec3(0, 1, 0);
}

}  // namespace softbody
