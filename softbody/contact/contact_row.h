#pragma once
// A contact as a row of a projected Gauss-Seidel solve: it limits the relative velocity of the closest points of two
// features, each of which follows the corners of its feature by their weights.

#include <array>
#include <cstdint>
#include <limits>

#include <glm/geometric.hpp>

#include "softbody/state/lanes.h"

namespace softbody {

struct ContactRow {
  std::array<std::uint32_t, 4> slot;
  std::array<float, 4> weight;    // first side positive, second negative
  std::array<float, 4> mobility;  // weight / mass
  glm::vec3 normal;               // unit, from the second side to the first
  float mass;                     // kg, effective: 1 / sum of weight^2 / mass
  float relative_stiffness;  // of the spring that keeps the distance, times the substep squared, over the mass; 0: out
                             // of its reach
  float bias;                // m/s, that the spring asks for
  float target;              // m/s, least normal speed
  float slack;               // m/s, by which it may be missed
  float push;                // m/s, at most so fast it pushes apart
  float before;              // m/s, the normal speed before the forces of the substep
  float restitution;
  float friction;
  float normal_impulse;        // N s, accumulated along the normal
  glm::vec3 friction_impulse;  // N s, accumulated across it
  float energy, returned;      // J, that the former gives by pushing apart, and that restitution gives back
  std::uint32_t feature;       // what it is of: a place in the search's features, or in a list of SolidContact
};

/// The value of ContactRow::feature where nothing is remembered of a row.
inline constexpr std::uint32_t uncached = std::numeric_limits<std::uint32_t>::max();

/// The mobility of the corners that are held: so little that no impulse moves them, and more than 0, so that their
/// velocities count.
inline constexpr float held_mobility = 1e-30f;
/// The mobility of a row up to which no corner moves: all are held, or belong to a body that does not move.
inline constexpr float least_mobility = 1e6f * held_mobility;

/// Returns the relative velocity (m/s) of the two closest points. A body that does not move has none, whatever it will
/// set out with.
inline glm::vec3 relative_velocity(const ContactRow& row, Field<const float> v) {
  glm::vec3 velocity(0.0f);
  for (std::size_t k = 0; k < 4; ++k) velocity += (row.mobility[k] != 0 ? row.weight[k] : 0) * read(v, row.slot[k]);
  return velocity;
}

/// Returns the work (J) of those who hold corners of a row, against its impulse.
inline float work_of_holders(const ContactRow& row, Field<const float> v) {
  const glm::vec3 impulse = row.normal_impulse * row.normal + row.friction_impulse;
  float sum = 0;
  for (std::size_t k = 0; k < 4; ++k)
    if (row.mobility[k] == held_mobility) sum -= row.weight[k] * glm::dot(impulse, read(v, row.slot[k]));
  return sum;
}

/// Changes the velocities of a row's corners by an impulse (N s).
inline void apply(const ContactRow& row, const glm::vec3& impulse, Field<float> v) {
  for (std::size_t k = 0; k < 4; ++k) add(v, row.slot[k], row.mobility[k] * impulse);
}

/// Changes the velocities so that one row meets its target and friction its cone, and adds to the row's impulses: one
/// step of projected Gauss-Seidel.
void solve_row(ContactRow& row, Field<float> v);

}  // namespace softbody
