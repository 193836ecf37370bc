#include "collide/box_sweep.h"

namespace collide {

void BoxSweep::begin(const BodyBoxes& bodies, std::span<const BodyPair> near_bodies, const std::vector<Box>& boxes,
                     bool within_bodies, float reach, int threads) {
  bodies_ = &bodies;
  near_bodies_ = near_bodies;
  boxes_ = &boxes;
  within_bodies_ = within_bodies;
  reach_ = reach;
  order_.resize(static_cast<std::size_t>(threads));
  of_body_.assign(bodies.box.size(), {0, 0});
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    Range& run = of_body_[boxes[b].body];
    if (run.size() == 0) run.begin = static_cast<Index>(b);
    run.end = static_cast<Index>(b + 1);
  }
}

void BoxSweep::add_near(Index body, const Aabb& region, std::vector<Index>& order) const {
  for (Index box = of_body_[body].begin; box < of_body_[body].end; ++box) {
    if (near((*boxes_)[box].region, region, reach_)) order.push_back(box);
  }
}

}  // namespace collide
