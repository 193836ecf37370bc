#pragma once
// Restitution. A contact stops the particles that come at it, and damps the rebound of the body that they belong to.
// What energy this takes in an impact is summed. If single particles were thrown back, the springs would turn that into
// swings and damp them; the body would not leave faster. So the share e^2 of that energy, with the restitution e, is
// given back to the body as a whole, along the contact's normals, when the two sides part and contact has hardly made
// them faster for a while.

#include <vector>

#include "softbody/state/state.h"

namespace softbody {

/// Takes what a contact has done in a frame: its impulse (N s) on the one side, and the energy (J) that restitution
/// gives back of what it took. Returns by how much (m/s) the velocity of that side relative to the other is to change
/// now. before, after: that velocity, m/s, without the impulse and at the end of the frame of `seconds`; mass: reduced,
/// kg.
glm::dvec3 rebound(Impact& impact, const glm::dvec3& impulse, double returned, const glm::dvec3& before,
                   const glm::dvec3& after, double mass, double seconds);

/// The impacts of bodies on each other.
class Rebounds {
 public:
  struct Pair {
    BodyId a, b;
    glm::dvec3 impulse{0.0};  // N s on a, in the frame at hand
    double returned = 0;      // J, likewise
    Impact impact{};
  };
  /// Adds what contact has done to two bodies in a part of a frame.
  void add(const Pair& done);
  /// Ends a frame of `seconds`: gives back what is due, to both bodies as wholes and with opposite impulses. Returns
  /// the energy (J). A body that is held somewhere has an infinite mass.
  double give_back(State& state, double seconds);
  /// Forgets the impacts of a body.
  void forget(BodyId body);
  /// Forgets a body that is removed; the ids of later bodies move up.
  void remove(BodyId body);
  std::size_t bytes() const { return bytes_of(pairs_); }

 private:
  std::vector<Pair> pairs_;
};

}  // namespace softbody
