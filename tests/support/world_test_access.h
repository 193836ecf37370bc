#pragma once
// A world's solver and its parts, for tests and benchmarks of the solver.

#include "softbody/world/world_parts.h"
#include "tests/support/penalty_test_access.h"

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
    PenaltyContact now = solver(world).penalty_contact();
    PenaltyPairs& pairs = PenaltyTestAccess::pairs(now);
    const State& state = world.state();
    const std::vector<Index>& first = world.parts_->particles.bodies.first;
    double sum = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const BodyId a = pairs.body_a[i], b = pairs.body_b[i];
      pairs.slot_a[i] = std::uint32_t(state.slot(a, pairs.contact[i].a - first[a]));
      pairs.slot_b[i] = std::uint32_t(state.slot(b, pairs.contact[i].b - first[b]));
      const glm::vec3 offset(state.body(a).origin - state.body(b).origin);
      for (int k = 0; k < 3; ++k) pairs.offset[std::size_t(k)][i] = offset[k];
      sum += now.energy(i, field(state.x));
    }
    return sum;
  }
  /// m, of the penalty force: grows slowly towards the tolerance.
  static float penalty_thickness(const World& world) {
    return world.parts_->solver.penalty_contact().layer().thickness;
  }
};

/// The parts of a solver with which a benchmark takes a frame by itself, stage by stage.
struct SolverTestAccess {
  explicit SolverTestAccess(Solver& s)
      : solver(s),
        shares(s.shares_),
        motion(s.motion_),
        penalty(s.penalty_),
        solids(s.solids_),
        contacts(s.contacts_),
        bounds(s.bounds_) {}
  StepBound begin_frame(double seconds) { return solver.begin_frame(seconds); }
  struct Series {
    int count;  // of substeps, that may be taken
    double h;   // s
  };
  /// Plans the rest of a frame (s), and finds the candidates of surface contact for it.
  Series plan_series(double left, StepBound bound) {
    const auto series = solver.plan_series(left, bound);
    return {series.trusted, series.h()};
  }
  void share_batches() { solver.share_batches(false); }
  double penalty_energy() { return solver.penalty_energy(); }

  Solver& solver;
  BatchShares& shares;
  Motion& motion;
  PenaltyContact& penalty;
  SolidContact& solids;
  ContactPass& contacts;
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
