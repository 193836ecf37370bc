#pragma once
// One soft body in plain double-precision arithmetic: what reports hold the solvers against. It shares a scene's data
// with them (springs, faces, the numbers of the gas law, the solids' shapes) and none of their arithmetic.

#include <string>
#include <vector>

#include "softbody/world.h"

namespace app {

/// Of one body's particles: m and m/s.
struct BodyState {
  std::vector<glm::dvec3> x, v;
};

/// As a world holds them.
BodyState state_of(const softbody::World& world, softbody::BodyId body);

class ReferenceBody {
 public:
  /// Both must outlive it. The prototype: of the scene's only body.
  ReferenceBody(const softbody::Prototype& prototype, const softbody::Scene& scene)
      : prototype_(prototype), scene_(scene) {}

  /// A stage of the plan that has a say in the motion and that this model does not know; empty: there is none, and the
  /// model is the scene's.
  static std::string unsupported_stage(const softbody::World& world);

  const softbody::Prototype& prototype() const { return prototype_; }
  const softbody::Scene& scene() const { return scene_; }
  /// m/s^2, of springs, dampers, gas and gravity.
  std::vector<glm::dvec3> accelerations(const BodyState& state) const;
  /// The classical Runge-Kutta step of h seconds; then the solids act on the velocities, so that no particle is below a
  /// surface after it.
  void step(BodyState& state, double h) const;
  /// s, for such a step in this state.
  double stable_step(const BodyState& state) const;
  /// J: kinetic, springs, gas (0 at the mesh's own volume) and gravity (0 at the world's origin).
  double energy(const BodyState& state) const;

 private:
  void add_spring(const softbody::Spring& spring, const BodyState& state, std::vector<glm::dvec3>& a) const;
  void add_gas(const BodyState& state, std::vector<glm::dvec3>& a) const;
  void touch_solids(const std::vector<glm::dvec3>& x, std::vector<glm::dvec3>& v, double h) const;

  const softbody::Prototype& prototype_;
  const softbody::Scene& scene_;
};

}  // namespace app
