#pragma once
// Energy, momentum and volume of bodies, in double.

#include <vector>

#include <glm/vec3.hpp>

#include "softbody/state/body.h"

namespace softbody {

class State;

/// Energies in J, without the energy that contacts store.
struct Energy {
  double kinetic = 0;
  double elastic = 0;  // of all forces inside bodies but:
  double gas = 0;      // those that depend on the volume
  double gravity = 0;  // measured from the world's origin
  double total() const { return kinetic + elastic + gas + gravity; }
  Energy& operator+=(const Energy& other);
};

struct BodyMeasures {
  Energy energy;
  double power = 0;          // W, of gravity and the forces inside the body: how fast they make kinetic energy
  glm::dvec3 momentum{0.0};  // kg m/s
  bool closed = false;
  double volume_ratio = 0;    // volume of a closed body over its starting volume
  double largest_strain = 0;  // of a spring, |length / resting length - 1|
  double max_speed = 0;       // m/s, of a particle
  bool finite = true;         // all positions and velocities

  /// Returns the energy (J) that an integrator conserves, exactly if forces are linear. staggered: s, the length of the
  /// last substep if the velocities belong to its middle, else 0: then the energy of fast oscillations oscillates, but
  /// for what the forces do in half a substep.
  double conserved(double staggered) const { return energy.total() + staggered / 2 * power; }
};

/// Measures a body, or all of them. gravity: m/s^2.
BodyMeasures measure(const State& state, BodyId body, const glm::dvec3& gravity);
std::vector<BodyMeasures> measure_bodies(const State& state, const glm::dvec3& gravity);

}  // namespace softbody
