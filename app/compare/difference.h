#pragma once
// What the second of two worlds side by side does otherwise than the first.

#include <string>
#include <string_view>
#include <vector>

#include "softbody/integrate/integrators.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::compare {

/// How a world is simulated.
struct HowSimulated {
  softbody::Scene scene;
  softbody::IntegratorChoice integrator;
  bool operator==(const HowSimulated&) const = default;
};

/// The settings in which two worlds may differ: method, levels, cell size, buckets, tolerance, contact surface and
/// integrator. In all else the second is as the first.
class Difference {
 public:
  Difference() = default;
  /// Of `second` from `first`. What is not of these settings does not count.
  Difference(const HowSimulated& first, HowSimulated second);

  /// Returns how the second world is simulated beside this first one.
  HowSimulated applied_to(HowSimulated first) const;
  /// Returns the scene with those of these settings that `first` has.
  static softbody::Scene shared(softbody::Scene scene, const softbody::Scene& first);
  /// Returns what this world has of the settings that differ, e.g. "Multi-Level SB, cells of 0.3 m"; "the same
  /// settings" if there is no difference.
  std::string text(const HowSimulated& world) const;

 private:
  bool has(std::string_view key) const;

  HowSimulated second_;
  std::vector<std::string_view> keys_;  // of the scene, whose values in second_ differ
  bool integrator_ = false;             // differs
};

/// Returns how a second world is simulated unless the user says otherwise, so that misses and their price can be seen:
/// by the paper's method with cells of half the automatic size; by the exact one beside the paper's.
HowSimulated usual_second(const softbody::BodiesInMotion& first, const softbody::IntegratorChoice& integrator);

}  // namespace app::compare
