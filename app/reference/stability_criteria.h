#pragma once
// The criteria by which a run of an extreme case is judged. They know no world: they turn figures of frames into
// verdicts.

#include <optional>
#include <string>
#include <vector>

namespace app::reference {

/// What is fixed at the start of a run.
struct StabilityLimits {
  double seconds = 0;          // length of the run
  double radius = 0;           // m, R of the smallest body of the scene, even of one that is added later
  bool begins_inside = false;  // some body begins inside a solid
};

/// The figures of one frame.
struct StabilitySample {
  double time = 0;     // s, at its end
  int frame = 0;       // from 1
  bool finite = true;  // all positions and velocities are; if not, the rest has no meaning
  /// Energy from nowhere that has not been lost again, see softbody::EnergyLedger, in max(E0 - E_eq, m g R) of the
  /// bodies that are there by now.
  double excess = 0;
  double speed = 0;                // of the fastest particle, in what all the energy could give it
  double extent = 0;               // longest side of a body's box, in that to which this energy could stretch it
  double depth = 0;                // m, of the deepest particle in a solid
  std::size_t passed_through = 0;  // bodies that have gone through a solid so far
};

/// How the end of a run differs from the reference's.
struct ReferenceDeviation {
  double shape = 0;   // R, RMS after moving and turning to fit
  double volume = 0;  // share of the reference's volume; 0 for open bodies
  double rest = 0;    // m/s, by how much the RMS of the motion within the body exceeds the reference's
};

/// Gathered frame by frame.
struct StabilityFigures {
  bool finite = true;    // all positions, velocities and derived figures are
  double energy = 0;     // largest excess energy / scale
  double speed = 0;      // largest speed / reachable speed
  double extent = 0;     // largest extent / reachable extent
  double transient = 0;  // R, largest depth in a solid; from frame 11 on if some body begins inside
  double steady = 0;     // R, largest depth in a solid in the last quarter of the run
  std::size_t passed_through = 0;
  std::optional<ReferenceDeviation> reference{};  // nothing: the run is judged by the other figures
  double blow_up_time = 0;                        // s, when the run was given up; 0: it was not
  std::string refused{};                          // why the solver refused to run; the rest has no meaning then

  void add(const StabilitySample& sample, const StabilityLimits& limits);
  /// Returns true if the run is not finite, or has ten times the scale in excess energy: it cannot recover.
  bool diverged() const { return blow_up_time > 0; }
};

struct StabilityBounds {
  double energy = 0.05, speed = 1, extent = 1;
  double transient = 0.1, steady = 0.02;  // R
  double shape = 0.01, volume = 0.01;     // R; of the volume
  double rest = 1e-3;                     // m/s
};
inline constexpr StabilityBounds stability_bounds;

/// Returns what is wrong, in words with numbers; empty if the run passes.
std::vector<std::string> failures(const StabilityFigures& figures);

}  // namespace app::reference
