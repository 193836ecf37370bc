#pragma once
// The pairs of penalty contact, as a structure of arrays, and the particles that they join.

#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include "collide/core/result.h"
#include "softbody/state/state.h"

namespace softbody {

/// A list of pairs. What kernels use fills whole blocks of `lanes`: the last ones stand for no pair, but join particle
/// 0 to itself.
struct PenaltyPairs {
  std::vector<collide::Contact> contact;  // the two vertices, over the whole world
  std::vector<BodyId> body_a, body_b;
  std::vector<std::uint32_t> slot_a, slot_b;  // in the state's arrays
  LaneArray<std::uint32_t> a, b;              // in the list of particles
  VectorArray offset;                         // origin of a minus origin of b, m
  VectorArray normal;                         // unit, from b to a
  VectorArray stretch;                        // of the friction spring, m: how far a has slipped along b
  LaneArray<float> stiffness, friction;       // N/m, and Coulomb's coefficient
  LaneArray<float> damped_mass;               // kg, see PenaltyContact::max_damped
  LaneArray<float> restitution;

  std::size_t size() const { return contact.size(); }
  bool empty() const { return contact.empty(); }
  void clear() { resize(0); }
  void resize(std::size_t count);
  /// Keeps only these pairs, whose numbers ascend.
  void keep(const std::vector<std::size_t>& which);
  std::size_t bytes() const;
};

/// The two vectors or rows of numbers that a table has for a particle.
struct alignas(32) PenaltyParticle {
  glm::vec4 first, second;
};

}  // namespace softbody
