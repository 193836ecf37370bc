#pragma once
// Copies of the positions of all vertices.

#include "collide/core/frame.h"
#include "softbody/mesh/points.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::compare {

/// World positions of all vertices, in metres.
struct Positions : softbody::Points {
  void copy(const collide::Frame& frame) {
    x.assign(frame.x.begin(), frame.x.end());
    y.assign(frame.y.begin(), frame.y.end());
    z.assign(frame.z.begin(), frame.z.end());
  }
};

/// A copy of a frame, or of some of its bodies.
struct FrameCopy {
  Positions at;
  collide::Bodies bodies;

  void copy(const collide::Frame& frame) {
    at.copy(frame);
    bodies = *frame.bodies;
  }
  /// Adds one body of a frame behind those that are there.
  void add(const collide::Frame& frame, collide::Index body) {
    const collide::Index begin = frame.bodies->first[body], end = frame.bodies->first[body + 1];
    at.x.insert(at.x.end(), frame.x.begin() + begin, frame.x.begin() + end);
    at.y.insert(at.y.end(), frame.y.begin() + begin, frame.y.begin() + end);
    at.z.insert(at.z.end(), frame.z.begin() + begin, frame.z.begin() + end);
    bodies.add(frame.bodies->shape[body]);
  }
  collide::Frame view() const { return {at.x, at.y, at.z, &bodies}; }
};

/// The positions of the meshes that a world shows, and of those that it simulates.
class WorldPositions {
 public:
  void copy(const softbody::BodiesInMotion& world) {
    const collide::Frame shown = world.positions(), simulated = world.simulated().positions;
    shown_.copy(shown);
    same_ = simulated.x.data() == shown.x.data();
    if (!same_) simulated_.copy(simulated);
  }
  const Positions& shown() const { return shown_; }
  const Positions& simulated() const { return same_ ? shown_ : simulated_; }

 private:
  Positions shown_, simulated_;
  bool same_ = true;  // simulated_ is not used
};

}  // namespace app::compare
