#pragma once
// A world's solver, for tests of the solver.

#include "softbody/world/world_state.h"

namespace softbody {

struct WorldTestAccess {
  static const Dynamics& dynamics(const World& world) { return world.state_->dynamics; }
  /// m, of the penalty force: grows slowly towards the tolerance.
  static float penalty_thickness(const World& world) { return world.state_->penalty_thickness; }
};

}  // namespace softbody
