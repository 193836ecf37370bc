#pragma once
// What every library has to do after it has named a pair: decide whether it is a contact, and put the list in order.

#include <vector>

#include "collide/detector.h"

namespace bench {

/// The project's definition of a contact, for vertices of one frame.
class ContactFilter {
 public:
  /// The frame must stay alive.
  void begin(const collide::Frame& frame, const collide::Settings& settings) {
    frame_ = frame;
    tolerance2_ = settings.tolerance * settings.tolerance;
    self_collision_ = settings.self_collision;
    if (body_.size() == frame.x.size() && first_ == frame.bodies->first) return;
    first_ = frame.bodies->first;
    body_.resize(frame.x.size());
    for (collide::Index b = 0; b + 1 < first_.size(); ++b)
      for (collide::Index v = first_[b]; v < first_[b + 1]; ++v) body_[v] = b;
  }
  collide::Index body(collide::Index vertex) const { return body_[vertex]; }

  /// For a != b in any order.
  bool contact(collide::Index a, collide::Index b) const {
    const auto& [x, y, z, bodies] = frame_;
    return collide::squared_distance(x[a], y[a], z[a], x[b], y[b], z[b]) < tolerance2_ && allowed(a, b);
  }
  /// The part of it that is not the distance.
  bool allowed(collide::Index a, collide::Index b) const {
    if (body_[a] != body_[b]) return true;
    const collide::Index first = first_[body_[a]];
    return self_collision_ && !frame_.bodies->shape[body_[a]]->excludes(a - first, b - first, tolerance2_);
  }

 private:
  collide::Frame frame_;
  float tolerance2_ = 0;
  bool self_collision_ = true;
  std::vector<collide::Index> first_, body_;  // body_: of each vertex, made once for bodies that stay
};

}  // namespace bench
