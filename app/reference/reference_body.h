#pragma once
// One soft body in plain double precision, with which the reports compare the solvers. It has forces and an integrator
// of its own. From the solvers it takes a scene's data (springs, faces, numbers of the gas law), the geometry of
// solids, and the bounds by which it chooses its step.

#include <string>
#include <vector>

#include "softbody/forces/springs.h"
#include "softbody/world/world.h"

namespace app::reference {

/// The positions (m) and velocities (m/s) of one body's particles.
struct BodyState {
  std::vector<glm::dvec3> x, v;
};

/// Returns the state of a body in a world.
BodyState state_of(const softbody::World& world, softbody::BodyId body);

class ReferenceBody {
 public:
  /// body model: of the scene's only body. Both arguments must outlive the object.
  ReferenceBody(const softbody::BodyModel& model, const softbody::Scene& scene) : model_(model), scene_(scene) {}

  /// Returns a stage of the world's plan that affects the motion and that this model lacks, or "several bodies"; empty
  /// if the model fits the scene.
  static std::string unsupported_stage(const softbody::World& world);

  const softbody::BodyModel& model() const { return model_; }
  const softbody::Scene& scene() const { return scene_; }
  /// Returns the accelerations (m/s^2) by springs, dampers, gas and gravity.
  std::vector<glm::dvec3> accelerations(const BodyState& state) const;
  /// Takes a classical Runge-Kutta step of h seconds. Solids correct the velocities, so that the step ends with
  /// no further particle below a surface.
  void step(BodyState& state, double h) const;
  /// Returns the largest stable step (s) in this state.
  double stable_step(const BodyState& state) const;
  /// Returns the energy (J): kinetic, springs, gas (0 at the mesh's own volume) and gravity (0 at the world's origin).
  double energy(const BodyState& state) const;

 private:
  void collide_with_solids(const std::vector<glm::dvec3>& x, std::vector<glm::dvec3>& v, double h) const;

  const softbody::BodyModel& model_;
  const softbody::Scene& scene_;
};

}  // namespace app::reference
