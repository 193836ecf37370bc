#pragma once
// One or two bodies of a world by themselves, as detectors see them.

#include "app/compare/positions.h"
#include "softbody/world.h"

namespace app {

class Excerpt {
 public:
  /// a <= b; of equal ones there is one.
  Excerpt(const softbody::World& world, softbody::BodyId a, softbody::BodyId b);

  collide::Frame frame() const { return {at_.x, at_.y, at_.z, &bodies_}; }
  /// The same pair of vertices, counted over the world.
  collide::Contact in_world(const collide::Contact& contact) const;

 private:
  collide::Index in_world(collide::Index vertex) const;

  Positions at_;
  collide::Bodies bodies_;
  std::array<collide::Index, 2> first_{};  // vertices in the world
};

}  // namespace app
