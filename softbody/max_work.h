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
  double shield = 1e7;    // pairs, times how often each is worked out: once a substep, and once a bound of these
  double at_once = double(1 << 24);  // candidates, 1.5 GiB; see candidates()
  /// In a world of more, a frame may be no more work than in one of so many, explicit substeps included.
  double most_particles = std::numeric_limits<double>::infinity();

  /// What `surface`, `implicit` and `shield` are multiplied by in a world of so many particles.
  double times(std::size_t particles) const {
    return std::max(1.0, std::min(double(particles), most_particles) / 10'000);
  }
  /// Explicit substeps in a world of so many, where any other may take `most`.
  int substeps(int most, std::size_t particles) const {
    const double part = std::min(1.0, most_particles / double(particles));
    return std::max(1, static_cast<int>(part * most));
  }
  /// At once in a world of so many: in proportion above 262,144 of them, but no more than 3 GiB.
  std::size_t candidates(std::size_t particles) const {
    constexpr double many = double(1 << 18), most = double(1 << 25);
    return static_cast<std::size_t>(std::min(at_once * std::max(1.0, double(particles) / many), most));
  }
};

/// Where somebody waits for each frame.
inline constexpr MaxWork work_of_a_window{.most_particles = 2.5e4};

}  // namespace softbody
