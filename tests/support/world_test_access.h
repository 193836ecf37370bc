#pragma once
// A world's solver and its parts, for tests and benchmarks of the solver.

#include "softbody/world/world_parts.h"

namespace softbody {

struct WorldTestAccess {
  static const Solver& solver(const World& world) { return world.parts_->solver; }
  static Solver& solver(World& world) { return world.parts_->solver; }
  /// N s, the normal impulses of solids on a body in the last step.
  static glm::dvec3 solid_impulse(const World& world, BodyId body) {
    return solver(world).solid_contact().push(body).impulse;
  }
  /// Gives bodies a material that may be beyond the limits of a scene.
  static void set_material(World& world, std::size_t index, const Material& material) {
    World::Parts& s = *world.parts_;
    const BodyModelSet before = s.models;
    s.models.set_material(int(index), material);
    for (std::size_t i = 0; i < before.all().size(); ++i)
      if (before.all()[i] != s.models.all()[i]) s.solver.state().replace(before.all()[i], s.models.all()[i]);
    s.update_plan();
  }
  /// J, that the penalty pairs of the last frame hold now.
  static double penalty_energy(const World& world) {
    const PenaltyContact& last = solver(world).penalty_contact();
    const State& state = world.state();
    double sum = 0;
    for (std::size_t i = 0; i < last.pairs.size(); ++i) {
      PenaltyPair p = last.pairs[i];
      const std::vector<Index>& first = world.parts_->particles.bodies.first;
      p.slot_a = std::uint32_t(state.slot(p.body_a, p.contact.a - first[p.body_a]));
      p.slot_b = std::uint32_t(state.slot(p.body_b, p.contact.b - first[p.body_b]));
      p.offset = glm::vec3(state.body(p.body_a).origin - state.body(p.body_b).origin);
      sum += last.energy(p, field(state.x));
    }
    return sum;
  }
  /// m, of the penalty force: grows slowly towards the tolerance.
  static float penalty_thickness(const World& world) { return world.parts_->solver.penalty_contact().layer.thickness; }
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
