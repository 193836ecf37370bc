#pragma once
// One or two bodies of a world as a frame of their own, for detectors.

#include "app/compare/positions.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::ui {

class BodySubset {
 public:
  /// Copies the bodies `a` and `b`, a <= b; if they are equal, the one body.
  BodySubset(const softbody::BodiesInMotion& world, softbody::BodyId a, softbody::BodyId b);

  collide::Frame frame() const { return copy_.view(); }
  /// Returns the contact with the world's indices of its vertices.
  collide::Contact to_world(const collide::Contact& contact) const;

 private:
  collide::Index to_world(collide::Index vertex) const;

  compare::FrameCopy copy_;
  std::array<collide::Index, 2> first_{};  // the first vertex of each body in the world
};

}  // namespace app::ui
