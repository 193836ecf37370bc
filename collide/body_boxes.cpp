#include "collide/body_boxes.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace collide {

namespace {

struct Extent {
  float lo, hi;
  bool finite;
};

/// Least and greatest of at least one value. Eight running values side by side, because the compiler may not reorder a
/// single running minimum into vector lanes.
Extent extent_of(std::span<const float> values) {
  constexpr std::size_t lanes = 8;
  constexpr float largest = std::numeric_limits<float>::max();
  std::array<float, lanes> lo, hi;
  std::array<std::uint32_t, lanes> bad{};
  lo.fill(values[0]);
  hi.fill(values[0]);
  const auto take = [&](std::size_t lane, float value) {
    lo[lane] = value < lo[lane] ? value : lo[lane];
    hi[lane] = value > hi[lane] ? value : hi[lane];
    bad[lane] |= !(value <= largest && value >= -largest);  // NaN fails both comparisons
  };
  std::size_t i = 0;
  for (; i + lanes <= values.size(); i += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) take(lane, values[i + lane]);
  }
  for (; i < values.size(); ++i) take(0, values[i]);
  return {*std::min_element(lo.begin(), lo.end()), *std::max_element(hi.begin(), hi.end()),
          std::all_of(bad.begin(), bad.end(), [](std::uint32_t lane) { return lane == 0; })};
}

}  // namespace

void BodyBoxes::build(const Frame& frame, Result& result) {
  const Bodies& bodies = *frame.bodies;
  const std::array coordinates{frame.x, frame.y, frame.z};
  result.contacts.clear();
  result.self_contacts = 0;
  result.counters = {};
  result.skipped = {};
  result.coverage = Coverage::exact;
  result.non_finite_bodies.clear();
  box.resize(bodies.count());
  live.clear();
  for (Index body = 0; body < bodies.count(); ++body) {
    const Index first = bodies.first[body], size = bodies.size(body);
    if (size == 0) continue;
    bool finite = true;
    for (int axis = 0; axis < 3; ++axis) {
      const Extent extent = extent_of(coordinates[static_cast<std::size_t>(axis)].subspan(first, size));
      box[body].lo[axis] = extent.lo;
      box[body].hi[axis] = extent.hi;
      finite = finite && extent.finite;
    }
    (finite ? live : result.non_finite_bodies).push_back(body);
  }
}

const std::vector<BodyPair>& BodyPairs::find(const BodyBoxes& bodies, float reach, std::size_t most_pairs) {
  pairs_.clear();
  order_ = bodies.live;
  sweep(
      order_, reach, [&](Index body) -> const Aabb& { return bodies.box[body]; },
      [&](Index a, Index b) {
        pairs_.push_back({std::min(a, b), std::max(a, b)});
        if (pairs_.size() > most_pairs) {
          throw std::length_error("more than " + std::to_string(most_pairs) + " pairs of near bodies");
        }
      });
  return pairs_;
}

}  // namespace collide
