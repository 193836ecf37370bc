#pragma once
// Scenes for measuring solvers. Only springs, gas, gravity and solids act on lone bodies, so that the reference models
// them.

#include "softbody/world/world.h"

namespace app::report {

using Particles = std::vector<softbody::Particle>;

/// Returns a material of 1 kg: springs of k N/m, bend springs of k / 4, and gas, without ambient pressure, that
/// inflates an icosphere by an eighth whatever k is. Only the springs damp.
softbody::Material ball_material(double stiffness, double damping_ratio);

/// Returns a scene of one body, at rest in balance at the origin, without gravity, solids and sleep.
softbody::Scene lone_scene(const softbody::Material& material);

/// Returns the particles of a body of the world.
Particles particles_of(const softbody::World& world, softbody::BodyId body);

struct SolverScene {
  std::string key, name;
  softbody::Scene scene{};
  std::vector<Particles> start{};  // per body; empty: as the scene has it
  bool at_rest = false;            // all motion is jitter
  bool of_centres = false;         // the error is the largest of a body's centre; else the RMS of all particles
  double promised = 0.01;          // R, the error that `auto` promises, see SolverCase::allowed()
  /// Copies side by side do not touch, so a batch of them can be timed.
  bool repeatable = true;
};

/// Returns the scenes of `report solver`: easy ones, and those in which IMEX Euler is weakest.
std::vector<SolverScene> solver_scenes();

}  // namespace app::report
