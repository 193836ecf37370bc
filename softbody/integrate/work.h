#pragma once
// The work of a frame, in one unit, and how much of it there may be.

#include <algorithm>
#include <cstddef>
#include <limits>

namespace softbody {

/// How much work things are. The unit is one particle in one explicit substep: about 10 ns on one thread, where 16
/// bodies share a block. `soak` prints how long a unit takes.
namespace work {
inline constexpr double substep = 300;     // each explicit substep, beside its particles and pairs
inline constexpr double bound = 2;         // a particle, each time that the bounds of steps are measured
inline constexpr double penalty_pair = 5;  // a pair in a substep
inline constexpr double surface = 3;       // what SurfaceContact::work_of_substep() and SurfaceSearch::work() count
inline constexpr double implicit = 50;     // what QuasiNewton::take_work() counts
// A particle in an implicit step, as it is estimated to choose an integrator; what is spent is counted as it is done.
// In heaps all bodies of a batch take as long as the one that is pressed most.
inline constexpr double implicit_in_flight = 150, implicit_on_solids = 300, implicit_in_contact = 2000;
}  // namespace work

/// The most work of a frame whose substeps are not fixed.
struct WorkBudget {
  double least = 1e8;           // in a world of any size
  double per_particle = 4'000;  // of all bodies
  double most = std::numeric_limits<double>::infinity();

  /// Returns the budget of a frame in a world of so many particles.
  double of(std::size_t particles) const { return std::min(most, std::max(least, per_particle * double(particles))); }
};

/// For a window, where somebody waits for each frame.
inline constexpr WorkBudget window_budget{.least = 4e7, .per_particle = 1'600, .most = 1e8};

/// The most candidates of surface contact at one time, for which a machine has to have the memory.
struct MaxCandidates {
  std::size_t least = std::size_t{1} << 24;  // 1.5 GiB
  std::size_t per_particle = 64;             // of all bodies
  std::size_t most = std::size_t{1} << 25;   // 3 GiB

  /// Returns that of a world of so many particles.
  std::size_t of(std::size_t particles) const { return std::min(most, std::max(least, per_particle * particles)); }
};

}  // namespace softbody
