#pragma once
// Energy, momentum, volume and penetration of bodies and of a whole world, in double.

#include "softbody/mechanics/body_measures.h"
#include "softbody/world/world.h"

namespace softbody {

BodyMeasures measure(const World& world, BodyId body);
std::vector<BodyMeasures> measure_bodies(const World& world);

class EnergyLedger;

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
  bool finite = true;    // all positions and velocities; else the other figures are NaN, or say nothing
};

Measures measure(const World& world);
/// The same, with the bodies measured already.
Measures measure(const World& world, std::span<const BodyMeasures> bodies);
/// Returns the sum of the measures of bodies, without their depth in solids.
Measures total(std::span<const BodyMeasures> bodies);

/// Returns the ledger of the work that is done on bodies.
const EnergyLedger& ledger(const World& world);
/// Returns the bodies that lie in a solid or in another body, which are eased out; ascending.
std::vector<BodyId> overlapping_bodies(const World& world);

/// Depth of a point in a solid, and the solid's outward normal there.
struct SolidDepth {
  glm::vec3 normal;
  double depth;  // m, negative outside
};
/// Returns the largest depth of a point in one of the scene's solids; -infinity if the scene has none.
SolidDepth solid_depth(const Scene& scene, const glm::dvec3& point);

/// Returns the tolerance (m) below which contact of vertices leaves room for a vertex to slip through a face: the
/// largest covering radius of a simulated mesh. 0 if the world's plan has no contact of vertices.
double safe_vertex_tolerance(const World& world);

struct SolidContactPoint {
  Index vertex;      // of the simulated meshes
  glm::vec3 normal;  // out of the solid
};
/// Returns the vertices that touch solids.
std::vector<SolidContactPoint> solid_contacts(const World& world);

}  // namespace softbody
