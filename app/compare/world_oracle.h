#pragma once
// The surface oracle on a world in motion.

#include "app/compare/positions.h"
#include "collide/core/workers.h"
#include "collide/oracle/surface_oracle.h"
#include "softbody/world.h"

namespace app {

/// The surface of each body, as the oracle wants them.
collide::surface::Surfaces surfaces_of(const softbody::World& world);

class WorldOracle {
 public:
  /// threads: of the oracle.
  explicit WorldOracle(int threads) : workers_(threads) {}

  /// What overlaps at this instant.
  collide::oracle::Overlaps overlaps(const softbody::World& world);

  /// m: how far a vertex is at the most from where it was when crossings() was called last; 0 before.
  double max_displacement(const softbody::World& world) const;

  /// What passed through what since the last call, each vertex taken along the straight line between the two: bodies
  /// that arrived in between are left out, and the first call finds nothing. To be called for one world only.
  std::vector<collide::oracle::Crossing> crossings(const softbody::World& world);
  /// Whether a vertex that crossed a face of a closed body in the last call came to be inside it. Crossings alone do
  /// not tell: of those through one face only the first is listed, and those through a rim are those of two.
  bool entered_body(const collide::oracle::Crossing& crossing) const;

 private:
  collide::Workers workers_;
  Positions before_, earlier_;           // of the last call and the one before it
  collide::Bodies bodies_;               // of before_
  collide::surface::Surfaces surfaces_;  // likewise
};

}  // namespace app
