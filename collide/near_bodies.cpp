#include "collide/near_bodies.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace collide {

namespace {

/// An integer that sorts as the float does.
std::uint32_t ordered(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

Index body_of(std::uint64_t key) { return static_cast<Index>(key); }

}  // namespace

void NearBodies::find(std::span<const Bound> bounds, std::span<const Index> live, float reach, Workers& workers) {
  sort(bounds, live);
  threads_.resize(static_cast<std::size_t>(workers.threads()));
  workers.run([&](int thread) {
    Thread& own = threads_[static_cast<std::size_t>(thread)];
    own.found.clear();
    own.count.clear();
    own.near_boxes = 0;
    for (auto i = static_cast<Index>(thread); i < boxes_.size; i += static_cast<Index>(workers.threads())) {
      const std::size_t before = own.found.size();
      own.near_boxes += sweep_row(boxes_, i, reach, own.found);
      own.count.push_back(static_cast<Index>(own.found.size() - before));
      if (own.found.size() > max_pairs) throw std::length_error("more than 134217728 pairs of near bodies");
    }
  });
  group(bounds.size());
}

void NearBodies::sort(std::span<const Bound> bounds, std::span<const Index> live) {
  boxes_.resize(static_cast<Index>(live.size()));
  order_.clear();
  if (live.empty()) return;
  glm::vec3 least = bounds[live[0]].box.lo, most = least;
  for (const Index body : live) {
    least = glm::vec3(std::min(least.x, bounds[body].box.lo.x), std::min(least.y, bounds[body].box.lo.y),
                      std::min(least.z, bounds[body].box.lo.z));
    most = glm::vec3(std::max(most.x, bounds[body].box.lo.x), std::max(most.y, bounds[body].box.lo.y),
                     std::max(most.z, bounds[body].box.lo.z));
  }
  const glm::vec3 spread = most - least;
  boxes_.axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
  for (const Index body : live) {
    order_.push_back(std::uint64_t{ordered(bounds[body].box.lo[boxes_.axis])} << 32 | body);
  }
  std::sort(order_.begin(), order_.end());
  for (std::size_t place = 0; place < order_.size(); ++place) {
    const Bound& bound = bounds[body_of(order_[place])];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<glm::length_t>(axis);
      boxes_.lo[axis][place] = bound.box.lo[a];
      boxes_.hi[axis][place] = bound.box.hi[a];
      boxes_.centre[axis][place] = bound.centre[a];
    }
    boxes_.radius[place] = bound.radius;
  }
}

/// By the smaller number of each pair: counting sort, then each group by itself.
void NearBodies::group(std::size_t bodies) {
  first_.assign(bodies + 1, 0);
  in_pair_.assign(bodies, false);
  near_boxes_ = 0;
  std::size_t pairs = 0;
  const auto for_each = [&](const auto& visit) {
    for (std::size_t thread = 0; thread < threads_.size(); ++thread) {
      std::size_t k = 0;
      for (std::size_t row = 0; row < threads_[thread].count.size(); ++row) {
        const Index body = body_of(order_[thread + row * threads_.size()]);
        for (const std::size_t end = k + threads_[thread].count[row]; k < end; ++k) {
          const Index other = body_of(order_[threads_[thread].found[k]]);
          visit(std::min(body, other), std::max(body, other));
        }
      }
    }
  };
  for_each([&](Index a, Index b) {
    ++first_[a];
    in_pair_[a] = in_pair_[b] = true;
    ++pairs;
  });
  if (pairs > max_pairs) throw std::length_error("more than 134217728 pairs of near bodies");
  alone_ = 0;
  for (const std::uint64_t key : order_) alone_ += !in_pair_[body_of(key)];
  for (const Thread& thread : threads_) near_boxes_ += thread.near_boxes;

  std::uint32_t end = 0;
  for (std::uint32_t& count : first_) count = end += count;  // becomes the end of each group
  other_.resize(pairs);
  for_each([&](Index a, Index b) { other_[--first_[a]] = b; });
  for (std::size_t body = 0; body < bodies; ++body) {
    std::sort(other_.begin() + first_[body], other_.begin() + first_[body + 1]);
  }
}

}  // namespace collide
