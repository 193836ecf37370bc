#pragma once
// Energy, momentum, volume and penetration of bodies and of a whole world, in double.

#include "softbody/world/world.h"

namespace softbody {

/// Energies in J, without the energy that contacts store.
struct Energy {
  double kinetic = 0;
  double elastic = 0;  // of all forces inside bodies but:
  double gas = 0;      // those that depend on the volume
  double gravity = 0;  // measured from the world's origin
  double deformation() const { return elastic + gas; }
  double total() const { return kinetic + elastic + gas + gravity; }
  Energy& operator+=(const Energy& other);
};

struct BodyMeasures {
  Energy energy;
  double staggering = 0;     // J, correction of the energy, see measure()
  glm::dvec3 momentum{0.0};  // kg m/s
  bool closed = false;
  double volume_ratio = 0;         // volume of a closed body over its starting volume
  double largest_strain = 0;       // of a spring, |length / resting length - 1|
  double deepest_penetration = 0;  // m, as in Measures
  double max_speed = 0;            // m/s, of a particle
  bool finite = true;              // all positions and velocities
};

/// Measures a body. `substep`: s, the length of the last substep of semi-implicit Euler, or 0 to leave `staggering`
/// out. The velocities of this integrator belong to the middle of a substep, so that the energy of fast oscillations
/// oscillates, too. The integrator conserves the energy plus `staggering`, exactly if forces are linear:
///
///   K(v) + 2 U(x - h/2 v) - (U(x) + U(x - h v)) / 2.
BodyMeasures measure(const World& world, BodyId body, double substep = 0);
std::vector<BodyMeasures> measure_bodies(const World& world, double substep = 0);

/// Returns the deformation energy of a body's starting shape. It is the minimum if the body starts in equilibrium.
Energy starting_energy(const BodyModel& model);

struct Measures {
  double energy = 0;                                  // J: the total of `energies`
  Energy energies;                                    // of all bodies
  glm::dvec3 momentum{0.0};                           // kg m/s
  bool has_volume = false;                            // some body is closed; else the ratios are 0
  double volume_ratio_min = 0, volume_ratio_max = 0;  // of closed bodies, over the starting volume
  double largest_strain = 0;                          // of a spring, |length / resting length - 1|
  /// m >= 0, how deep the deepest particle lies below a solid's surface; by surface contact the deepest point of faces
  double deepest_penetration = 0;
  double max_speed = 0;  // m/s, of a particle
  bool finite = true;    // all positions and velocities
};

Measures measure(const World& world);
/// Returns the sum of the measures of all bodies.
Measures total(std::span<const BodyMeasures> bodies);

/// Returns the bodies that lie in a solid or in another body, which are eased out; ascending.
std::vector<BodyId> overlapping_bodies(const World& world);

/// Depth of a point in a solid, and the solid's outward normal there.
struct SolidDepth {
  glm::vec3 normal;
  double depth;  // m, negative outside
};
/// Returns the largest depth of a point in one of the scene's solids; -infinity if the scene has none.
SolidDepth solid_depth(const Scene& scene, const glm::dvec3& point);

struct SolidContactPoint {
  Index vertex;      // over the whole world
  glm::vec3 normal;  // out of the solid
};
/// Returns the vertices that touch solids.
std::vector<SolidContactPoint> solid_contacts(const World& world);

}  // namespace softbody
