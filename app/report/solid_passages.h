#pragma once

#include <vector>

#include "softbody/world.h"

namespace app {

/// m, world, the mean of a body's vertices.
glm::dvec3 middle_of(const softbody::World& world, collide::Index body);

/// Counts how often a closed body has gone through a solid: its middle has, straight from where it was outside last.
/// That of one wrapped around a solid may lie inside for a while, but comes out again on the side that it went in.
class SolidPassages {
 public:
  /// Once before the first step and after each. Returns false if some middle is not finite.
  bool look(const softbody::World& world);
  std::size_t count() const { return count_; }

 private:
  bool passed(const softbody::World& world, const glm::dvec3& from, const glm::dvec3& to, double radius) const;

  std::vector<glm::dvec3> outside_;  // the last middles that were in no solid
  std::size_t count_ = 0;
};

}  // namespace app
