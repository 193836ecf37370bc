#pragma once
// The response to the detector's contacts. "A tolerance force that acts like a shield" is the paper's (§2.3); its law
// is ours: along a unit normal n, fixed for a frame, two particles with separation d push each other apart by
//
//   F = k w min(h - s, h) clamp(1 - u / v, 0, 3)    s = d . n,  w = 1 - (d^2 - s_^2) / h^2,  s_ = min(s, 0),
//
// which fades out where the detector loses sight of the pair, at |d| = h, so that contacts come and go without a jump -
// in front of the surface. A pair that comes into sight from behind it is pushed out with full force at once: work that
// nobody has put in, as when solids push out what is in them.
// h is the thickness of the contact layer, k its stiffness, u the speed at which the two separate: Hunt and Crossley's
// damping (1975), under which nothing is thrown back faster than v. Friction across n is Cundall and Strack's (1979): a
// spring of stiffness k that the slip stretches, with a damper, cut off at Coulomb's limit; it holds from frame to
// frame as long as the pair does, so that bodies stick and not merely creep. Between closed bodies n comes from the
// surfaces' normals, so that a particle that has slipped through is still pushed out; elsewhere it is the line between
// the two. k is shared among the contacts of a particle: a wide contact layer is not stiffer.

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "collide/core/detector.h"
#include "softbody/forces/force.h"

namespace softbody {

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

  static constexpr float rebound_speed = 2.0f;   // v, m/s
  static constexpr float approach_limit = 3.0f;  // upper clamp of the damping factor
  float thickness = 0;                           // h, m
  std::vector<PenaltyPair> pairs;
  std::vector<glm::vec3> force;          // on a, of the current substep, N
  std::vector<PenaltyEnd> ends;          // grouped by batch
  std::vector<std::uint32_t> first_end;  // batches + 1 offsets into ends

  /// Evaluates the forces of the pairs in `part` and stretches their friction springs by `seconds` of slip.
  void evaluate(collide::Part part, Field<const float> x, Field<const float> v, float seconds);
  /// J: the work of the undamped push along n until the pair is out of sight, and what its friction spring holds.
  double energy(const PenaltyPair& pair, Field<const float> x) const;
  double energy(Field<const float> x) const;  // J, of all pairs
  /// How fast the force on a falls with the motion of a in the coming `seconds`, at least: N/m along and across n.
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
  /// Finds again where the bodies' particles stand in the state's arrays, and how far apart their origins are.
  void locate(const State& state);
  /// Returns the ends of pairs that fall to a batch.
  std::span<const PenaltyEnd> ends_of(const Batch& batch) const;
  /// Forgets a body of `count` vertices from `first` on; bodies and vertices after it move up.
  void remove(BodyId body, Index first, Index count);

  // What the law adds at one particle whose contacts share the stiffness k, for the stability bound.
  static float stiffness_bound(float k) { return (4.0f / 3 * approach_limit + 1) * k; }  // N/m
  static float damping_bound(float k, float friction, float thickness) {                 // N s/m
    return max_damping(friction) * k * thickness / rebound_speed;
  }
  /// N: of a contact as deep as can be, damped as much as can be.
  float max_force(const PenaltyPair& pair) const {
    return approach_limit * max_damping(pair.friction) * pair.stiffness * thickness;
  }
  /// N s/m: the most that a pair does in the coming `seconds` if its speed stays.
  float predicted_damping(const PenaltyPair& pair, Field<const float> x, Field<const float> v, float seconds) const;

 private:
  void add_pairs(const DetectedContacts& detected, const State& state);
  void group(const State& state);

  static constexpr float sticking_damping = 0.5f;  // across n, over k h / v
  /// Of a contact as deep as can be, over k h / v: 1 along n, and Coulomb's limit, which that moves, across n.
  static float max_damping(float friction) { return std::sqrt(1 + friction * friction); }
};

}  // namespace softbody
