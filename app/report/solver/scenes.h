#pragma once
// Scenes for measuring solvers: nothing acts in them but springs, gas, gravity and solids, so that the reference's
// model is the scene's.

#include "softbody/world.h"

namespace app {

using Particles = std::vector<softbody::Particle>;

/// Springs of k N/m, bend springs of k / 4, and gas, without ambient pressure, that inflates an icosphere by an eighth
/// whatever k is: 1 kg, and what damps is the springs' damping ratio alone.
softbody::Material ball_material(double stiffness, double damping_ratio);

/// One body of that material at rest in balance at the origin; no gravity, no solids, no sleep.
softbody::Scene lone_scene(const softbody::Material& material);

/// The body's particles as a world would start them.
Particles particles_of(const softbody::World& world, softbody::BodyId body);

struct SolverScene {
  std::string key, name;
  softbody::Scene scene{};
  std::vector<Particles> start{};  // a body; empty: as the scene has it
  bool at_rest = false;            // what moves is jitter
  /// Side by side so many bodies of it cost as much as one: they do not touch.
  bool repeatable = true;
};

/// Those of `report solver`.
std::vector<SolverScene> solver_scenes();

}  // namespace app
