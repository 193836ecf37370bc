#pragma once
// The positions at which vertices are drawn; in slow motion these lie between two steps.

#include <cassert>

#include <glm/common.hpp>

#include "app/compare/positions.h"

namespace app::compare {

/// The positions at the fraction `part` of the way from x, y, z to `now`. Vertices that x, y, z lack are drawn at
/// `now`. Owns nothing.
struct DrawnPositions {
  collide::Frame now{};
  std::span<const float> x{}, y{}, z{};  // before the last step
  float part = 1;

  std::size_t size() const { return now.x.size(); }
  glm::vec3 operator[](std::size_t i) const {
    assert(i < size());
    const glm::vec3 here(now.x[i], now.y[i], now.z[i]);
    if (part >= 1 || i >= x.size()) return here;
    return glm::mix(glm::vec3(x[i], y[i], z[i]), here, part);
  }
};

/// The positions at which the meshes of a world are drawn: those that it shows, and those that it simulates.
struct DrawnMeshes {
  DrawnPositions shown, simulated;

  /// From `before` to the present of the world, both of which must outlive this.
  DrawnMeshes(const softbody::BodiesInMotion& world, const WorldPositions& before, float part)
      : shown(between(before.shown(), world.positions(), part)),
        simulated(between(before.simulated(), world.simulated().positions, part)) {}
  /// At the present of the world.
  explicit DrawnMeshes(const softbody::BodiesInMotion& world)
      : shown{.now = world.positions()}, simulated{.now = world.simulated().positions} {}

 private:
  static DrawnPositions between(const Positions& before, const collide::Frame& now, float part) {
    return {now, before.x, before.y, before.z, part};
  }
};

}  // namespace app::compare
