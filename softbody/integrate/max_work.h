#pragma once
// The bounds of a frame's work.

#include <algorithm>
#include <cstddef>
#include <limits>

namespace softbody {

/// Of a frame, unless the number of substeps is fixed.
inline constexpr int max_substeps = 4000, max_implicit_steps = 1024;

/// The most work of a frame in a world of 10,000 particles; it grows in proportion in larger worlds. Fixed substeps are
/// bound by at_once only. The project's own scenes reach at most a third of `surface`.
struct MaxWork {
  double surface = 2e7;   // of surface contact: SurfaceContact::work_of_substep() and SurfaceSearch::work()
  double implicit = 4e6;  // iterations of the implicit solver, times the particles of a body, and its sweeps
  double penalty = 1e7;   // vertex pairs, times how often each is evaluated: once a substep and once a substep bound
  double at_once = double(1 << 24);  // candidates of surface contact at one time, 1.5 GiB; see candidates()
  /// A frame in a world of more particles may do no more work than in a world of so many, explicit substeps included.
  double max_counted_particles = std::numeric_limits<double>::infinity();

  /// Returns the factor of `surface`, `implicit` and `penalty` in a world of so many particles.
  double times(std::size_t particles) const {
    return std::max(1.0, std::min(double(particles), max_counted_particles) / 10'000);
  }
  /// Returns the most explicit substeps in a world of so many particles, `most` in a small one.
  int scaled_substeps(int most, std::size_t particles) const {
    const double part = std::min(1.0, max_counted_particles / double(particles));
    return std::max(1, static_cast<int>(part * most));
  }
  /// Returns the most candidates at one time in a world of so many particles: they grow in proportion above 262,144
  /// particles, up to 3 GiB.
  std::size_t candidates(std::size_t particles) const {
    constexpr double many = double(1 << 18), most = double(1 << 25);
    return static_cast<std::size_t>(std::min(at_once * std::max(1.0, double(particles) / many), most));
  }
};

/// For a window, where somebody waits for each frame.
inline constexpr MaxWork work_of_a_window{.max_counted_particles = 2.5e4};

}  // namespace softbody
