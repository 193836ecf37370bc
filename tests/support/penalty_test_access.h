#pragma once
// Pairs of penalty contact one by one, for tests that make or read some.

#include <glm/vec3.hpp>

#include "softbody/forces/penalty_contact.h"

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

inline PenaltyPair pair_of(const PenaltyPairs& p, std::size_t i) {
  return {.contact = p.contact[i],
          .body_a = p.body_a[i],
          .body_b = p.body_b[i],
          .slot_a = p.slot_a[i],
          .slot_b = p.slot_b[i],
          .offset = read(field(p.offset), i),
          .normal = read(field(p.normal), i),
          .stiffness = p.stiffness[i],
          .friction = p.friction[i],
          .damped_mass = p.damped_mass[i],
          .restitution = p.restitution[i],
          .stretch = read(field(p.stretch), i)};
}

struct PenaltyTestAccess {
  static ContactLayer& layer(PenaltyContact& penalty) { return penalty.memory_.layer; }
  static PenaltyPairs& pairs(PenaltyContact& penalty) { return penalty.memory_.pairs; }
  static void add(PenaltyContact& penalty, const PenaltyPair& pair) {
    PenaltyPairs& p = pairs(penalty);
    const std::size_t i = p.size();
    p.resize(i + 1);
    p.contact[i] = pair.contact;
    p.body_a[i] = pair.body_a, p.body_b[i] = pair.body_b;
    p.slot_a[i] = pair.slot_a, p.slot_b[i] = pair.slot_b;
    for (int k = 0; k < 3; ++k) {
      p.offset[std::size_t(k)][i] = pair.offset[k];
      p.normal[std::size_t(k)][i] = pair.normal[k];
      p.stretch[std::size_t(k)][i] = pair.stretch[k];
    }
    p.stiffness[i] = pair.stiffness, p.friction[i] = pair.friction, p.damped_mass[i] = pair.damped_mass;
    p.restitution[i] = pair.restitution;
  }
  /// Finds the particles that the pairs join by their slots, which are below `slots`.
  static void group(PenaltyContact& penalty, std::size_t slots) {
    collide::Workers alone(1);
    penalty.group(slots, {}, alone, 1);
  }
  /// Hands the friction springs of the pairs `before` on to the same contacts; both ascend.
  static void carry_over(PenaltyContact& penalty, const PenaltyPairs& before) {
    penalty.carry_over({0, penalty.pairs().size()}, before.contact, before.stretch);
  }
};

}  // namespace softbody
