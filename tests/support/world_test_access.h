#pragma once
// A world's solver, for tests of the solver.

#include "softbody/world/world_parts.h"

namespace softbody {

struct WorldTestAccess {
  static const Solver& solver(const World& world) { return world.parts_->solver; }
  /// J, that the penalty pairs of the last frame hold now.
  static double penalty_energy(const World& world) {
    PenaltyContact last = solver(world).penalty_contact();
    const State& state = world.state();
    for (PenaltyPair& p : last.pairs) {  // bodies may have moved in the state, and their origins have followed them
      p.slot_a = state.slot(p.body_a, p.vertex_a);
      p.slot_b = state.slot(p.body_b, p.vertex_b);
      p.offset = glm::vec3(state.body(p.body_a).origin - state.body(p.body_b).origin);
    }
    return last.energy(field(state.x));
  }
  /// m, of the penalty force: grows slowly towards the tolerance.
  static float penalty_thickness(const World& world) { return world.parts_->penalty_thickness; }
};

/// Returns the point (m) that the hand holds.
inline glm::dvec3 grabbed_point(const World& world) {
  const Grab& grab = *world.grabbed();
  glm::dvec3 point(0.0);
  for (int i = 0; i < 3; ++i)
    point += grab.weights[i] * world.particle(grab.body, grab.corners[std::size_t(i)]).position;
  return point;
}

}  // namespace softbody
