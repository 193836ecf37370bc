#include "collide/exact/body_broad_phase.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <glm/common.hpp>

namespace collide::exact {

namespace {

constexpr double cell_width = 0.5;       // of the mean box
constexpr std::size_t cells_a_body = 4;  // at most, lest most of them be empty

[[noreturn]] void throw_too_many_pairs(std::size_t most) {
  throw std::length_error("more than " + std::to_string(most) + " pairs of near bodies");
}

}  // namespace

void BodyBroadPhase::find(std::span<const BodyBounds> bounds, std::span<const Index> live, float cutoff,
                          Workers& workers, std::size_t limit) {
  assert(cutoff > 0 && std::is_sorted(live.begin(), live.end()));
  first_.assign(bounds.size() + 1, 0);  // no pairs, should this fail
  other_.clear();
  divide(bounds, live, cutoff);
  place(bounds, live);
  constexpr double row_ns = 100, sort_ns = 20;  // of work, of a body
  const auto bodies = static_cast<double>(live.size());
  const int parts = workers.threads_for(row_ns * bodies);
  threads_.resize(static_cast<std::size_t>(parts));
  workers.run(parts, [&](int part) {
    Thread& own = threads_[static_cast<std::size_t>(part)];
    own.found.clear();
    own.count.clear();
    own.near_box_pairs = 0;
    const Part rows = part_of(live.size(), part, parts);
    for (auto row = static_cast<Index>(rows.begin); row < rows.end; ++row) {
      const std::size_t before = own.found.size();
      find_row(own, row, cutoff);
      own.count.push_back(static_cast<Index>(own.found.size() - before));
      if (own.found.size() > limit) throw_too_many_pairs(limit);
    }
  });
  group(bounds.size(), limit);
  const int sort_parts = workers.threads_for(sort_ns * bodies);
  workers.run(sort_parts, [&](int part) {
    const Part own = part_of(bounds.size(), part, sort_parts);
    for (std::size_t body = own.begin; body < own.end; ++body) {
      std::sort(other_.begin() + first_[body], other_.begin() + first_[body + 1]);
    }
  });
}

std::size_t BodyBroadPhase::Parts::of(double value) const {
  const double part = (value - first) / width;
  return part > 0 ? std::min(static_cast<std::size_t>(std::min(part, 1e18)), count - 1) : 0;
}

/// Chooses strips and cells for the boxes.
void BodyBroadPhase::divide(std::span<const BodyBounds> bounds, std::span<const Index> live, float cutoff) {
  const glm::vec3 lowest(std::numeric_limits<float>::lowest());
  glm::vec3 least(-lowest), most(lowest);
  glm::dvec3 widest(0), sum(0);
  for (const Index body : live) {
    const Aabb& box = bounds[body].box;
    const glm::dvec3 width = glm::dvec3(box.hi) - glm::dvec3(box.lo);
    least = glm::min(least, box.lo);
    most = glm::max(most, box.lo);
    widest = glm::max(widest, width);
    sum += width;
  }
  const glm::dvec3 spread = glm::max(glm::dvec3(most) - glm::dvec3(least), 0.0);
  along_ = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
  const int one = (along_ + 1) % 3, two = (along_ + 2) % 3;
  across_ = spread[one] >= spread[two] ? one : two;
  const auto parts = [&](int axis, double width, std::size_t max_parts) {
    width = std::max(width, spread[axis] / static_cast<double>(max_parts));
    if (!(width > 0)) width = 1;
    return Parts{least[axis], width, std::min(max_parts, static_cast<std::size_t>(spread[axis] / width) + 1)};
  };
  const std::size_t bodies = std::max<std::size_t>(live.size(), 1);
  strips_ = parts(across_, widest[across_] + cutoff, bodies);
  cells_ = parts(along_, cell_width * sum[along_] / static_cast<double>(bodies), cells_a_body * bodies / strips_.count);
}

/// Counting sort by strip and cell.
void BodyBroadPhase::place(std::span<const BodyBounds> bounds, std::span<const Index> live) {
  widest_.assign(strips_.count, 0);
  cell_begin_.assign(strips_.count * cells_.count + 2, 0);
  cell_.clear();
  for (const Index body : live) {
    const Aabb& box = bounds[body].box;
    const std::size_t strip = strips_.of(box.lo[across_]);
    widest_[strip] = std::max(widest_[strip], double{box.hi[along_]} - box.lo[along_]);
    cell_.push_back(static_cast<Index>(strip * cells_.count + cells_.of(box.lo[along_])));
    ++cell_begin_[cell_.back() + std::size_t{2}];
  }
  for (std::size_t cell = 2; cell < cell_begin_.size(); ++cell) cell_begin_[cell] += cell_begin_[cell - 1];
  boxes_.resize(static_cast<Index>(live.size()));
  body_.resize(live.size());
  for (std::size_t k = 0; k < live.size(); ++k) {
    const BodyBounds& bound = bounds[live[k]];
    const Index place = cell_begin_[cell_[k] + std::size_t{1}]++;  // in the end, where the next cell begins
    body_[place] = live[k];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<glm::length_t>(axis);
      boxes_.lo[axis][place] = bound.box.lo[a];
      boxes_.hi[axis][place] = bound.box.hi[a];
      boxes_.centre[axis][place] = bound.centre[a];
    }
    boxes_.radius[place] = bound.radius;
  }
}

/// Those behind it in its own strip, and those of the strips that it reaches into.
void BodyBroadPhase::find_row(Thread& own, Index place, float cutoff) const {
  const auto along = static_cast<std::size_t>(along_), across = static_cast<std::size_t>(across_);
  const double lo = boxes_.lo[along][place], hi = boxes_.hi[along][place];
  const std::size_t last_cell = cells_.of(hi + cutoff);
  const std::size_t strip = strips_.of(boxes_.lo[across][place]);
  const std::size_t last_strip = strips_.of(double{boxes_.hi[across][place]} + cutoff);
  const auto sweep = [&](std::size_t s, Index begin) {
    const Index end = cell_begin_[s * cells_.count + last_cell + 1];
    own.near_box_pairs += sweep_strip(boxes_, place, begin, end, cutoff, own.found);
  };
  sweep(strip, place + 1);
  for (std::size_t next = strip + 1; next <= last_strip; ++next) {
    // Boxes that end within cutoff of this one begin at most their width earlier; the margin is for rounding.
    const double earliest = lo - cutoff - widest_[next];
    const std::size_t first_cell = cells_.of(earliest - 1e-6 * (std::abs(earliest) + widest_[next]));
    sweep(next, cell_begin_[next * cells_.count + first_cell]);
  }
}

/// Counting sort by the smaller number of each pair.
void BodyBroadPhase::group(std::size_t bodies, std::size_t limit) {
  in_pair_.assign(bodies, 0);
  near_box_pairs_ = 0;
  std::size_t pairs = 0;
  const auto for_each = [&](const auto& visit) {
    Index row = 0;
    for (const Thread& own : threads_) {
      auto found = own.found.begin();
      for (const Index count : own.count) {
        const Index body = body_[row++];
        for (const auto end = found + count; found != end; ++found) {
          visit(std::min(body, body_[*found]), std::max(body, body_[*found]));
        }
      }
    }
  };
  for_each([&](Index a, Index b) {
    ++first_[a];
    in_pair_[a] = in_pair_[b] = 1;
    ++pairs;
  });
  if (pairs > limit) {
    first_.assign(bodies + 1, 0);
    throw_too_many_pairs(limit);
  }
  isolated_bodies_ = body_.size() - static_cast<std::size_t>(std::count(in_pair_.begin(), in_pair_.end(), 1));
  for (const Thread& thread : threads_) near_box_pairs_ += thread.near_box_pairs;

  std::uint32_t end = 0;
  for (std::uint32_t& count : first_) count = end += count;  // becomes the end of each group
  other_.resize(pairs);
  for_each([&](Index a, Index b) { other_[--first_[a]] = b; });
}

}  // namespace collide::exact
