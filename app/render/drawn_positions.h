#pragma once
// The positions at which vertices are drawn; in slow motion these lie between two steps.

#include <cassert>

#include <glm/common.hpp>

#include "app/compare/positions.h"

namespace app::render {

/// The positions at the fraction `part` of the way from `before`, before the last step, to `now`. Vertices that
/// `before` lacks are drawn at `now`. Owns nothing.
struct DrawnPositions {
  collide::Frame now{};
  softbody::ConstPoints before{};
  float part = 1;

  std::size_t size() const { return now.x.size(); }
  glm::vec3 operator[](std::size_t i) const {
    assert(i < size());
    const glm::vec3 here(now.x[i], now.y[i], now.z[i]);
    return part >= 1 || i >= before.x.size() ? here : glm::mix(before[i], here, part);
  }
};

/// The positions at which the meshes of a world are drawn: those that it shows, and those that it simulates.
struct DrawnMeshes {
  DrawnPositions shown, simulated;

  /// From `before` to the present of the world, both of which must outlive this.
  DrawnMeshes(const softbody::BodiesInMotion& world, const compare::WorldPositions& before, float part)
      : shown{world.positions(), before.shown(), part},
        simulated{world.simulated().positions, before.simulated(), part} {}
  /// At the present of the world.
  explicit DrawnMeshes(const softbody::BodiesInMotion& world)
      : shown{.now = world.positions()}, simulated{.now = world.simulated().positions} {}
};

}  // namespace app::render
