#pragma once
// What a run on an extreme case is judged by, as numbers. Knows no world: figures of frames come in, verdicts go out.

#include <optional>
#include <string>
#include <vector>

namespace app {

/// Fixed at the start.
struct StabilityLimits {
  double energy = 0;           // J, at the start, of all that a sample counts
  double seconds = 0;          // that the run takes
  double radius = 0;           // m, R of the smallest body of the scene, whenever it joins
  bool begins_inside = false;  // a solid
};

/// One frame.
struct StabilitySample {
  double time = 0;     // s, at its end
  int frame = 0;       // from 1
  bool finite = true;  // all positions and velocities; if not, the rest has no meaning
  double energy = 0;   // J: kinetic, springs, gas, gravity, and what bodies have put into shields
  double work = 0;     // J, that came from outside so far: solids push out what is in them, bodies join with theirs
  double scale = 0;    // J, max(E0 - E_eq, m g R) of the bodies that have begun or joined by now
  double speed = 0,
         reachable_speed = 0;  // m/s: of the fastest particle, and what all the energy there may be could give it
  double extent = 0, reachable_extent = 0;  // m: the longest box of a body, and how long that energy could draw it
  double depth = 0;                         // m, the deepest particle in a solid
  std::size_t passed_through = 0;           // bodies that have gone through a solid so far
};

/// How the end differs from the reference's.
struct ReferenceDeviation {
  double shape = 0;   // R, RMS once moved and turned to fit
  double volume = 0;  // of the reference's; 0 for what holds none
  double rest = 0;    // m/s, RMS of the motion within the body, above the reference's
};

struct StabilityFigures {
  bool finite = true;    // all positions and velocities, and what is worked out from them
  double energy = 0;     // above what it may have, in the scale: the largest
  double speed = 0;      // in its reach: the largest
  double extent = 0;     // in its reach: the largest
  double transient = 0;  // R, deepest in a solid; from the 11th frame on if it began inside
  double steady = 0;     // R, deepest in a solid in the last quarter of the time
  std::size_t passed_through = 0;
  std::optional<ReferenceDeviation> reference{};  // none: it is judged on the rest
  double blow_up_time = 0;                        // s, when the run was given up; 0: it was not
  std::string refused{};                          // why the solver would not run; then nothing else has a meaning
};

struct StabilityBounds {
  double energy = 0.05, speed = 1, extent = 1;
  double transient = 0.1, steady = 0.02;  // R
  double shape = 0.01, volume = 0.01;     // R; of the volume
  double rest = 1e-3;                     // m/s
};
inline constexpr StabilityBounds stability_bounds;

class StabilityAssessment {
 public:
  explicit StabilityAssessment(const StabilityLimits& limits) : limits_(limits) {}
  void add(const StabilitySample& sample);
  /// It is not finite, or has ten times the energy that it may: nothing better will come.
  bool diverged() const { return figures_.blow_up_time > 0; }
  const StabilityFigures& figures() const { return figures_; }

 private:
  StabilityLimits limits_;
  StabilityFigures figures_;
};

/// What is wrong, in words with the numbers; empty: it passes.
std::vector<std::string> failures(const StabilityFigures& figures);

}  // namespace app
