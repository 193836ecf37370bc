#include "collide/methods/subdivision.h"

#include <cassert>
#include <cmath>

namespace collide::methods {

namespace {

/// An empty box with the region of a code: one interval of each axis.
SubdividedBox box_of(const std::array<Cuts, 3>& cuts, std::uint32_t code, Index body) {
  SubdividedBox box{{}, {}, body, {0, 0}};
  for (int axis = 0; axis < 3; ++axis) {
    const Cuts& along = cuts[static_cast<std::size_t>(axis)];
    const std::uint32_t interval = code & ((1u << along.depth) - 1);
    code >>= along.depth;
    box.region.lo[axis] = along.border[interval];
    box.region.hi[axis] = along.border[interval + 1];
    box.interval[static_cast<std::size_t>(axis)] = static_cast<std::uint8_t>(interval);
  }
  return box;
}

}  // namespace

void Subdivision::build(const Frame& frame, const BodyBoxes& bodies, std::span<const Index> which, int levels,
                        Workers& workers) {
  assert(levels >= 0 && levels <= max_levels);
  levels_ = levels;
  first_slot_.clear();
  Index slots = 0;
  for (const Index body : which) {
    first_slot_.push_back(slots);
    slots += frame.bodies->size(body);
  }
  points_.resize(slots);
  constexpr double vertex_ns = 10, box_ns = 1;  // of work
  const int parts = workers.threads_for(vertex_ns * slots + box_ns * std::ldexp(which.size(), levels));
  threads_.resize(static_cast<std::size_t>(parts));
  workers.run(parts, [&](int number) {
    Thread& own = threads_[static_cast<std::size_t>(number)];
    own.boxes.clear();
    own.codes_in_use.reset(Index{1} << levels);
    own.of_code.assign(std::size_t{1} << levels, 0);
    const Part part = part_of(which.size(), number, parts);
    for (std::size_t k = part.begin; k < part.end; ++k) {
      cut_body(own, frame, bodies.box[which[k]], which[k], first_slot_[k]);
    }
  });
  boxes_.clear();
  for (const Thread& thread : threads_) boxes_.insert(boxes_.end(), thread.boxes.begin(), thread.boxes.end());
}

void Subdivision::cut_body(Thread& own, const Frame& frame, const Aabb& box, Index body, Index first_slot) {
  own.cuts = cuts_of(box, levels_);
  const Index first = frame.bodies->first[body], size = frame.bodies->size(body);
  find_codes(own, frame, first, size);

  for (const std::uint32_t code : own.code) {
    own.codes_in_use.add(code);
    ++own.of_code[code];
  }
  Index slot = first_slot;
  own.codes_in_use.take_runs(0, [&](Range codes) {
    for (Index code = codes.begin; code < codes.end; ++code) {
      const Index count = std::exchange(own.of_code[code], slot);
      own.boxes.push_back(box_of(own.cuts, code, body));
      own.boxes.back().slots = {slot, slot + count};
      slot += count;
    }
  });
  for (Index v = 0; v < size; ++v) points_.set(own.of_code[own.code[v]]++, frame, first + v, body);
  for (const std::uint32_t code : own.code) own.of_code[code] = 0;
}

void Subdivision::find_codes(Thread& own, const Frame& frame, Index first, Index size) const {
  const auto& [along_x, along_y, along_z] = own.cuts;
  own.code.resize(size);
  for (Index v = 0; v < size; ++v) {
    const auto x = static_cast<std::uint32_t>(along_x.interval_of(frame.x[first + v]));
    const auto y = static_cast<std::uint32_t>(along_y.interval_of(frame.y[first + v]));
    const auto z = static_cast<std::uint32_t>(along_z.interval_of(frame.z[first + v]));
    own.code[v] = x | y << along_x.depth | z << (along_x.depth + along_y.depth);
  }
}

}  // namespace collide::methods
