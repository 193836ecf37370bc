#pragma once
// The bounds of a frame's work.

#include <algorithm>
#include <cstddef>
#include <limits>

namespace softbody {

/// What a frame may be at most, in a world of 10,000 particles; in larger ones more in proportion. Fixed substeps are
/// bound by at_once only. Scenes as they are shipped come to a third of the first at most.
struct MaxWork {
  double surface = 2e7;   // contact of surfaces: SurfaceContact::work_of_substep(), and SurfaceSearch::work()
  double implicit = 4e6;  // iterations of the implicit solver, times the particles of a body, and its sweeps
  double at_once = double(1 << 24);  // candidates, 1.5 GiB; see candidates()
  /// In a world of more, a frame may be no more work than in one of so many, explicit substeps included.
  double most_particles = std::numeric_limits<double>::infinity();
  static constexpr double many_particles = double(1 << 18), most_at_once = double(1 << 25);
  /// At once in a world of so many: in proportion, but no more than 3 GiB.
  std::size_t candidates(std::size_t particles) const {
    const double in_proportion = at_once * std::max(1.0, double(particles) / many_particles);
    return static_cast<std::size_t>(std::min(in_proportion, most_at_once));
  }
};

/// Where somebody waits for each frame.
inline constexpr MaxWork work_of_a_window{.most_particles = 2.5e4};

}  // namespace softbody
