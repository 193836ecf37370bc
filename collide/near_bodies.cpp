#include "collide/near_bodies.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <glm/common.hpp>

namespace collide {

namespace {

/// An integer that sorts as the float does.
std::uint32_t ordered(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

constexpr std::size_t most_strips = 4096;

[[noreturn]] void throw_too_many_pairs(std::size_t most) {
  throw std::length_error("more than " + std::to_string(most) + " pairs of near bodies");
}

}  // namespace

void NearBodies::find(std::span<const Bound> bounds, std::span<const Index> live, float reach, Workers& workers,
                      std::size_t most_pairs) {
  first_.assign(bounds.size() + 1, 0);  // no pairs, should this fail
  other_.clear();
  sort(bounds, live, reach);
  threads_.resize(static_cast<std::size_t>(workers.threads()));
  workers.run([&](int thread) {
    Thread& own = threads_[static_cast<std::size_t>(thread)];
    own.found.clear();
    own.count.clear();
    own.near_boxes = 0;
    for (auto i = static_cast<Index>(thread); i < boxes_.size; i += static_cast<Index>(workers.threads())) {
      const std::size_t before = own.found.size();
      find_row(own, i, reach);
      own.count.push_back(static_cast<Index>(own.found.size() - before));
      if (own.found.size() > most_pairs) throw_too_many_pairs(most_pairs);
    }
  });
  group(bounds.size(), most_pairs);
}

/// Those behind it in its own strip, and those of the strips that it reaches into.
void NearBodies::find_row(Thread& own, Index place, float reach) const {
  const std::size_t strip = order_[place].key >> 32;
  own.near_boxes += sweep_strip(boxes_, place, place + 1, strips_[strip].end, reach, own.found);
  const auto across = static_cast<std::size_t>(across_), along = static_cast<std::size_t>(boxes_.along);
  const std::size_t last = strip_of(double{boxes_.hi[across][place]} + reach);
  for (std::size_t next = strip + 1; next <= last; ++next) {
    const Strip& other = strips_[next];
    const auto begin = boxes_.lo[along].begin() + other.begin, end = boxes_.lo[along].begin() + other.end;
    // Boxes that end within reach of this one begin at most their width earlier; the margin is for rounding.
    const double earliest = (double{boxes_.lo[along][place]} - reach - other.widest);
    const auto first = std::lower_bound(begin, end, earliest - 1e-6 * (std::abs(earliest) + other.widest));
    own.near_boxes +=
        sweep_strip(boxes_, place, static_cast<Index>(first - boxes_.lo[along].begin()), other.end, reach, own.found);
  }
}

/// Never decreases with the value.
std::size_t NearBodies::strip_of(double value) const {
  const double strip = (value - first_edge_) / width_;
  return strip > 0 ? std::min(static_cast<std::size_t>(std::min(strip, 1e9)), strips_.size() - 1) : 0;
}

void NearBodies::sort(std::span<const Bound> bounds, std::span<const Index> live, float reach) {
  boxes_.resize(static_cast<Index>(live.size()));
  order_.clear();
  strips_.clear();
  if (live.empty()) return;
  const glm::vec3 lowest(std::numeric_limits<float>::lowest());
  glm::dvec3 least(-lowest), most(lowest), widest(0);
  for (const Index body : live) {
    const glm::dvec3 lo(bounds[body].box.lo), hi(bounds[body].box.hi);
    least = glm::min(least, lo);
    most = glm::max(most, lo);
    widest = glm::max(widest, hi - lo);
  }
  const glm::dvec3 spread = most - least;
  boxes_.along = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
  const int one = (boxes_.along + 1) % 3, two = (boxes_.along + 2) % 3;
  across_ = spread[one] >= spread[two] ? one : two;
  first_edge_ = least[across_];
  width_ = std::max(widest[across_] + reach, spread[across_] / most_strips);
  if (!(width_ > 0)) width_ = 1;
  strips_.resize(std::min(most_strips, static_cast<std::size_t>(spread[across_] / width_) + 1), {0, 0, 0});

  for (const Index body : live) {
    const glm::vec3& lo = bounds[body].box.lo;
    order_.push_back({std::uint64_t{strip_of(lo[across_])} << 32 | ordered(lo[boxes_.along]), body});
  }
  std::sort(order_.begin(), order_.end(),
            [](const Place& a, const Place& b) { return a.key != b.key ? a.key < b.key : a.body < b.body; });
  for (Index place = 0; place < order_.size(); ++place) {
    const Bound& bound = bounds[order_[place].body];
    Strip& strip = strips_[order_[place].key >> 32];
    if (strip.begin == strip.end) strip.begin = place;
    strip.end = place + 1;
    strip.widest = std::max(strip.widest, bound.box.hi[boxes_.along] - bound.box.lo[boxes_.along]);
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
void NearBodies::group(std::size_t bodies, std::size_t most_pairs) {
  in_pair_.assign(bodies, false);
  near_boxes_ = 0;
  std::size_t pairs = 0;
  const auto for_each = [&](const auto& visit) {
    for (std::size_t thread = 0; thread < threads_.size(); ++thread) {
      std::size_t k = 0;
      for (std::size_t row = 0; row < threads_[thread].count.size(); ++row) {
        const Index body = order_[thread + row * threads_.size()].body;
        for (const std::size_t end = k + threads_[thread].count[row]; k < end; ++k) {
          const Index other = order_[threads_[thread].found[k]].body;
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
  if (pairs > most_pairs) {
    first_.assign(bodies + 1, 0);
    throw_too_many_pairs(most_pairs);
  }
  alone_ = 0;
  for (const Place& place : order_) alone_ += !in_pair_[place.body];
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
