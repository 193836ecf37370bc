#include "collide/core/body_boxes.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <string>

#include "collide/core/vertex_kernels.h"

namespace collide {

void BodyBoxes::build(const Frame& frame, Result& result) {
  assert(is_complete(frame));
  const Bodies& bodies = *frame.bodies;
  result.start();
  result.contacts.clear();
  box.resize(bodies.count());
  live.clear();
  for (Index body = 0; body < bodies.count(); ++body) {
    if (bodies.size(body) == 0) continue;
    const BodyBounds bound = measure_bounds(vertices_of(frame, body));
    box[body] = bound.box;
    (bound.finite ? live : result.non_finite_bodies).push_back(body);
  }
}

const std::vector<BodyPair>& BodyPairs::find(const BodyBoxes& bodies, float cutoff, std::size_t limit) {
  pairs_.clear();
  order_ = bodies.live;
  sweep(
      order_, cutoff, [&](Index body) -> const Aabb& { return bodies.box[body]; },
      [&](Index a, Index b) {
        pairs_.push_back({std::min(a, b), std::max(a, b)});
        if (pairs_.size() > limit) {
          throw std::length_error("more than " + std::to_string(limit) + " pairs of near bodies");
        }
      });
  return pairs_;
}

}  // namespace collide
