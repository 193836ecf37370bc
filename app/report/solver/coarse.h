#pragma once
// What a coarse mesh that is simulated in place of a fine one costs and saves.

#include <vector>

namespace app::report {

/// A fine body that falls on a solid sphere, simulated by so many particles.
struct CoarseRun {
  std::size_t particles;
  double distance;  // R, between the two surfaces at rest, see softbody::coarsen(); 0: the mesh itself is simulated
  double middle;    // R: the most that its middle is away from that of the finest run
  double shape;     // R, the same of its vertices about the middle, RMS
  double cost;      // time of the solver, in that of the finest run
};

struct CoarseResults {
  std::size_t vertices = 0;     // of the mesh
  std::vector<CoarseRun> runs;  // from coarse to fine
};

/// Measures the creature of the scene `shapes` at several resolutions, the finest of them the mesh itself. quick: once,
/// with fewer.
CoarseResults measure_coarse(bool quick);

}  // namespace app::report
