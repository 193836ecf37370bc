#pragma once
// Scenes for measuring solvers. Only springs, gas, gravity and solids act in them, so that the reference models them.

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
  /// Copies side by side do not touch, so a batch of them can be timed.
  bool repeatable = true;
};

/// Returns the scenes of `report solver`.
std::vector<SolverScene> solver_scenes();

}  // namespace app::report
