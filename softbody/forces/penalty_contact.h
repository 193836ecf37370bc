#pragma once
// The response to the detector's contacts: a penalty force between the vertices of each, by penalty_law.h. The friction
// spring of a pair holds from frame to frame as long as the pair does, so that bodies stick and not merely creep.
// Between closed bodies n comes from the surfaces' normals, so that a particle that has slipped through is still pushed
// out; elsewhere it is the line between the two. The stiffness is shared among the contacts of a particle: a wide
// contact layer is not stiffer.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "collide/core/detector.h"
#include "softbody/forces/force.h"

namespace softbody {

template <class Real>
struct PenaltyLaw;

/// Contacts that a detector has found.
struct DetectedContacts {
  const collide::Bodies& vertices;
  std::span<const BodyId> vertex_body;  // the body of each vertex
  const std::vector<collide::Contact>& contacts;
};

struct PenaltyPair {
  collide::Contact contact;  // the two vertices, over the whole world
  BodyId body_a, body_b;
  Index vertex_a, vertex_b;    // of their bodies
  std::size_t slot_a, slot_b;  // in the state's arrays
  glm::vec3 offset;            // origin of a minus origin of b, m
  glm::vec3 normal;            // unit, from b to a
  float stiffness;             // N/m
  float friction;              // Coulomb
  float damped_mass;           // kg, see PenaltyContact::max_damped
  glm::vec3 stretch{0.0f};     // of the friction spring, m: how far a has slipped along b
};

/// The end of a pair that falls to one batch.
struct PenaltyEnd {
  std::size_t slot;
  std::uint32_t pair;
  float sign;  // +1 for a, -1 for b
};

struct PenaltyContact {
  static constexpr std::string_view key = "contact-response";
  static constexpr bool internal = false;
  static const char* why_not(const ForceFacts& facts) { return facts.why_no_vertex_contact; }
  static void adapt(Material& material, const MeshSource& source);

  /// Adds the forces that evaluate() has found.
  void add(const ForceBatch& batch) const;

  /// The largest share of a pair's relative velocity that a damper takes away in a substep, if the pair has the damped
  /// mass: that of its lighter particle, over the number of contacts there. All dampers on a particle together add no
  /// more than 2 gamma h = 4 max_damped to omega^2 h^2 + 2 gamma h <= 4, the condition of stable_step(). Of the 4, a
  /// step of 0.8 times the stable length leaves 4 (1 - 0.8^2). So contacts ask for no shorter steps by their damping.
  static constexpr float max_damped = 0.36f;
  float damper_limit = std::numeric_limits<float>::infinity();  // 1/s, of a damper over the damped mass
  float thickness = 0;                                          // of the contact layer, m
  std::vector<PenaltyPair> pairs;
  std::vector<glm::vec3> force;          // on a, of the current substep, N
  std::vector<PenaltyEnd> ends;          // grouped by batch
  std::vector<std::uint32_t> first_end;  // batches + 1 offsets into ends

  /// Evaluates the forces of the pairs in `part` and stretches their friction springs by `seconds` of slip.
  void evaluate(collide::Part part, Field<const float> x, Field<const float> v, float seconds);
  template <class Real>
  PenaltyLaw<Real> law_of(const PenaltyPair& pair) const;
  /// Returns what the law stores, in J.
  double energy(const PenaltyPair& pair, Field<const float> x) const;
  double energy(Field<const float> x) const;  // J, of all pairs
  /// Returns upper bounds of how fast the force on a falls with the motion of a in the coming `seconds`, in N/m.
  struct Slopes {
    float spring, damper;                // along n
    float across_spring, across_damper;  // while it sticks
  };
  Slopes slopes(const PenaltyPair& pair, Field<const float> x, Field<const float> v, float seconds) const;
  /// Takes the contacts for the coming frame, and hands the friction springs of those that were there before on to
  /// them. thickness: of the contact layer, m. The contacts ascend.
  void find(const DetectedContacts& detected, const State& state, float thickness);
  /// Hands the friction springs of `before` on to the same contacts of `pairs`; both ascend.
  void carry_over(std::span<const PenaltyPair> before);
  /// Returns the ends of pairs that fall to a batch.
  std::span<const PenaltyEnd> ends_of(const Batch& batch) const;
  /// Forgets a body of `count` vertices from `first` on; bodies and vertices after it move up.
  void remove(BodyId body, Index first, Index count);

 private:
  void add_pairs(const DetectedContacts& detected, const State& state);
  void group(const State& state);
};

}  // namespace softbody
