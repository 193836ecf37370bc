#pragma once
// The pairs of penalty contact, as a structure of arrays, and the particles that they join.

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "collide/core/result.h"
#include "softbody/state/state.h"

namespace softbody {

struct PenaltyPair {
  collide::Contact contact;  // the two vertices, over the whole world
  BodyId body_a, body_b;
  std::uint32_t slot_a, slot_b;  // in the state's arrays
  glm::vec3 offset;              // origin of a minus origin of b, m
  glm::vec3 normal;              // unit, from b to a
  float stiffness;               // N/m
  float friction;                // Coulomb
  float damped_mass;             // kg, see PenaltyContact::max_damped
  float restitution = 0;
  glm::vec3 stretch{0.0f};  // of the friction spring, m: how far a has slipped along b
};

/// A list of pairs. What kernels use fills whole blocks of `lanes`: the last ones stand for no pair, but join particle
/// 0 to itself.
class PenaltyPairs {
 public:
  std::vector<collide::Contact> contact;
  std::vector<BodyId> body_a, body_b;
  std::vector<std::uint32_t> slot_a, slot_b;
  LaneArray<std::uint32_t> a, b;  // in the list of particles
  VectorArray offset, normal, stretch;
  LaneArray<float> stiffness, friction, damped_mass, restitution;

  std::size_t size() const { return contact.size(); }
  bool empty() const { return contact.empty(); }
  void clear() { resize(0); }
  void resize(std::size_t count);
  void push_back(const PenaltyPair& pair);
  PenaltyPair operator[](std::size_t i) const;
  std::size_t bytes() const;
};

/// The two vectors or rows of numbers that a table has for a particle.
struct alignas(32) PenaltyParticle {
  glm::vec4 first, second;
};

}  // namespace softbody
