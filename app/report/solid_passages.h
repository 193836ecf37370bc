#pragma once
// Bodies that pass through solids.

#include <vector>

#include "softbody/world/world.h"

namespace app::report {

/// Counts how often a closed body has gone through a solid: its middle has, on a straight line from where it was
/// outside last, in on one side and out on the opposite one. The middle of a body that is wrapped around a solid may be
/// inside for a while, but comes out on the same side, or round a corner on the side beside it.
class SolidPassages {
 public:
  /// Call it once before the first step and after each step. Returns false if some middle is not finite.
  bool observe(const softbody::World& world);
  std::size_t count() const { return count_; }

 private:
  bool passed(const softbody::World& world, const glm::dvec3& from, const glm::dvec3& to, double radius) const;

  std::vector<glm::dvec3> outside_;  // the last middles that were in no solid
  std::size_t count_ = 0;
};

}  // namespace app::report
