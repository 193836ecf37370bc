#pragma once
// A world's solver and its parts, for tests and benchmarks of the solver.

#include "softbody/world/world_parts.h"

namespace softbody {

struct WorldTestAccess {
  static const Solver& solver(const World& world) { return world.parts_->solver; }
  static Solver& solver(World& world) { return world.parts_->solver; }
  /// J, that the penalty pairs of the last frame hold now.
  static double penalty_energy(const World& world) {
    PenaltyContact last = solver(world).penalty_contact();
    if (last.pairs.empty()) return 0;
    last.locate(world.parts_->particles.bodies, world.state());
    last.measure({0, last.pairs.size()});
    return last.energy();
  }
  /// m, of the penalty force: grows slowly towards the tolerance.
  static float penalty_thickness(const World& world) { return world.parts_->penalty_thickness; }
};

/// The parts of a solver with which a benchmark takes a frame by itself, stage by stage.
struct SolverTestAccess {
  explicit SolverTestAccess(Solver& s)
      : solver(s), crew(s.crew_), motion(s.motion_), penalty(s.penalty_), solids(s.solids_), bounds(s.bounds_) {}
  void begin_frame(double seconds) { solver.begin_frame(seconds); }
  void share_batches() { solver.share_batches(false); }
  double penalty_energy() { return solver.penalty_energy(); }

  Solver& solver;
  Crew& crew;
  Motion& motion;
  PenaltyContact& penalty;
  SolidContact& solids;
  StepBounds& bounds;
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
