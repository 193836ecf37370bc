#pragma once
// Applies the surface oracle to the simulated meshes of a world in motion.

#include "app/compare/positions.h"
#include "collide/core/workers.h"
#include "collide/oracle/surface_oracle.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::compare {

/// Returns the simulated surface of each body, for the oracle.
collide::surface::Surfaces surfaces_of(const softbody::BodiesInMotion& world);

class WorldOracle {
 public:
  /// threads: the number of threads that the oracle uses.
  explicit WorldOracle(int threads) : workers_(threads) {}

  /// Returns what overlaps now.
  collide::oracle::Overlaps overlaps(const softbody::BodiesInMotion& world);

  /// Returns the largest displacement of a vertex (m) since the last call of crossings(); 0 before the first. Bodies
  /// may have been added since, but not removed.
  double max_displacement(const softbody::BodiesInMotion& world) const;

  /// Returns what passed through what since the last call, if each vertex moved in a straight line. Bodies that were
  /// added in between are left out, and the first call finds nothing. Call it for one world only.
  std::vector<collide::oracle::Crossing> crossings(const softbody::BodiesInMotion& world);
  /// Returns true if a vertex that crossed a face of a closed body in the last call is now inside the body. The
  /// crossing alone does not say so: only the first one through each face is listed, and one through the rim of a
  /// face is listed for both faces.
  bool entered_body(const collide::oracle::Crossing& crossing) const;

 private:
  collide::Workers workers_;
  FrameCopy before_;                     // at the last call of crossings()
  Positions earlier_;                    // at the one before it
  collide::surface::Surfaces surfaces_;  // of before_
};

}  // namespace app::compare
