#pragma once
// Pairs of near boxes without a grid: sort and sweep, between near bodies and within each body.

#include "collide/subdivision.h"

namespace collide {

class BoxSweep {
 public:
  /// near_bodies: what BodyPairs found for the same reach. All of it must stay alive for for_each_pair().
  void begin(const BodyBoxes& bodies, std::span<const BodyPair> near_bodies, const std::vector<Box>& boxes,
             bool within_bodies, float reach, int threads);

  /// The part of one thread of all pairs a < b of boxes within reach of each other: calls meet(a, b) once for each.
  /// Within one body only if begin() was told so.
  template <class Meet>
  void for_each_pair(int thread, int threads, const Meet& meet);

 private:
  /// The boxes of a body that are within reach of the region.
  void add_near(Index body, const Aabb& region, std::vector<Index>& order) const;

  const BodyBoxes* bodies_ = nullptr;
  std::span<const BodyPair> near_bodies_;
  const std::vector<Box>* boxes_ = nullptr;
  bool within_bodies_ = false;
  float reach_ = 0;
  std::vector<Range> of_body_;             // the boxes of each body
  std::vector<std::vector<Index>> order_;  // by thread
};

template <class Meet>
void BoxSweep::for_each_pair(int thread, int threads, const Meet& meet) {
  const std::vector<Box>& boxes = *boxes_;
  const auto region = [&](Index box) -> const Aabb& { return boxes[box].region; };
  std::vector<Index>& order = order_[static_cast<std::size_t>(thread)];

  const Part between = part_of(near_bodies_.size(), thread, threads);
  for (std::size_t k = between.begin; k < between.end; ++k) {
    const auto [a, b] = near_bodies_[k];
    order.clear();
    add_near(a, bodies_->box[b], order);
    add_near(b, bodies_->box[a], order);
    sweep(order, reach_, region, [&](Index one, Index other) {
      if (boxes[one].body != boxes[other].body) meet(std::min(one, other), std::max(one, other));
    });
  }
  if (!within_bodies_) return;
  const Part within = part_of(bodies_->live.size(), thread, threads);
  for (std::size_t k = within.begin; k < within.end; ++k) {
    const Index body = bodies_->live[k];
    order.clear();
    add_near(body, bodies_->box[body], order);
    sweep(order, reach_, region, [&](Index one, Index other) { meet(std::min(one, other), std::max(one, other)); });
  }
}

}  // namespace collide
