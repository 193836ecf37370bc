#include "collide/exact/resting_contacts.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

namespace collide::exact {

bool RestingContacts::same_bodies(const Frame& frame, const Settings& settings) const {
  return settings.tolerance == tolerance_ && settings.self_collision == self_collision_ &&
         frame.bodies->first == first_ && frame.bodies->shape == shape_;
}

void RestingContacts::observe(const Frame& frame, const Settings& settings, std::span<const BodyBounds> bounds,
                              Workers& workers) {
  assert(bounds.size() == frame.bodies->count());
  const bool stored = std::exchange(stored_, false);
  if (!same_bodies(frame, settings)) {
    tolerance_ = settings.tolerance;
    self_collision_ = settings.self_collision;
    first_ = frame.bodies->first;
    shape_ = frame.bodies->shape;
    bounds_.assign(bounds.begin(), bounds.end());
    motion_.assign(bounds.size(), Motion::moving);
    for (auto* coordinate : {&x_, &y_, &z_}) coordinate->resize(frame.x.size());
    return;
  }
  constexpr double copied_body_ns = 20, copied_vertex_ns = 0.5;  // of work
  const int parts = workers.threads_for(copied_body_ns * static_cast<double>(bounds.size()) +
                                        copied_vertex_ns * static_cast<double>(frame.x.size()));
  workers.run(parts, [&](int number) {
    const Part part = part_of(bounds.size(), number, parts);
    for (auto body = static_cast<Index>(part.begin); body < part.end; ++body) {
      motion_[body] = observe(vertices_of(frame, body), bounds[body], body);
      if (!stored) motion_[body] = std::min(motion_[body], Motion::copied);
    }
  });
}

RestingContacts::Motion RestingContacts::observe(const VertexRun& now, const BodyBounds& bound, Index body) {
  if (now.size == 0) return Motion::moving;
  const BodyBounds before = std::exchange(bounds_[body], bound);
  if (!bound.finite || !before.finite || bound.box != before.box) return Motion::moving;
  const std::size_t first = first_[body], bytes = now.size * sizeof(float);
  if (motion_[body] != Motion::moving && std::memcmp(now.x, &x_[first], bytes) == 0 &&
      std::memcmp(now.y, &y_[first], bytes) == 0 && std::memcmp(now.z, &z_[first], bytes) == 0) {
    return Motion::resting;
  }
  std::memcpy(&x_[first], now.x, bytes);
  std::memcpy(&y_[first], now.y, bytes);
  std::memcpy(&z_[first], now.z, bytes);
  return Motion::copied;
}

std::optional<std::span<const Contact>> RestingContacts::group(Index body, const BodyBroadPhase& near) const {
  if (!is_resting(body)) return std::nullopt;
  const auto resting = [&](Index other) { return is_resting(other); };
  const auto before = std::span(near_).subspan(near_begin_[body], near_begin_[body + 1] - near_begin_[body]);
  const std::span<const Index> now = near.later_neighbours(body);
  if (!std::all_of(before.begin(), before.end(), resting) || !std::all_of(now.begin(), now.end(), resting)) {
    return std::nullopt;
  }
  return std::span(contacts_).subspan(group_begin_[body], group_begin_[body + 1] - group_begin_[body]);
}

void RestingContacts::store(const Frame& frame, const BodyBroadPhase& near, std::span<const Contact> contacts) {
  if (std::all_of(motion_.begin(), motion_.end(), [](Motion motion) { return motion == Motion::moving; })) return;
  contacts_.assign(contacts.begin(), contacts.end());
  const Index bodies = frame.bodies->count();
  group_begin_.clear();
  near_.clear();
  near_begin_.assign(1, 0);
  auto at = contacts.begin();
  for (Index body = 0; body < bodies; ++body) {
    group_begin_.push_back(static_cast<std::size_t>(at - contacts.begin()));
    at = std::lower_bound(at, contacts.end(), Contact{first_[body + 1], 0});
    const std::span<const Index> others = near.later_neighbours(body);
    near_.insert(near_.end(), others.begin(), others.end());
    near_begin_.push_back(static_cast<Index>(near_.size()));
  }
  group_begin_.push_back(contacts.size());
  stored_ = true;
}

}  // namespace collide::exact
