#pragma once
// Totals over a world, all in double: energy, momentum, volume, penetration.

#include "softbody/world.h"

namespace softbody {

struct Measures {
  double energy = 0;         // J: kinetic + springs + gas + gravity (measured from the world's origin)
  glm::dvec3 momentum{0.0};  // kg m/s
  bool has_volume = false;   // some body is closed; else the ratios are 0
  double volume_ratio_min = 0, volume_ratio_max = 0;  // of closed bodies, over the starting volume
  double deepest_penetration = 0;                     // m >= 0, the deepest particle below a solid's surface
  double max_speed = 0;                               // m/s, of a particle
  bool finite = true;                                 // all positions and velocities
};

Measures measure(const World& world);

/// How deep a point lies in a solid, with the solid's outward normal there.
struct SolidDepth {
  glm::vec3 normal;
  double depth;  // m, negative outside
};
/// The deepest of the scene's solids at a point; depth is -infinity if the scene has none.
SolidDepth solid_depth(const Scene& scene, const glm::dvec3& point);

}  // namespace softbody
