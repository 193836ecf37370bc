#include "collide/group_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <glm/common.hpp>

#include "collide/reach.h"

namespace collide {

namespace {

constexpr std::size_t most_pairs_between_counts = 1u << 16;  // of one thread

/// See Slab. With u = 2^-24, a projection errs by at most 7u of the largest coordinate, the sum with the reach by 3u of
/// it, and the normal is longer than 1 by a few u. Nothing where squares could overflow or underflow.
std::optional<Slab> slab_between(const Bound& a, const Bound& b, float reach) {
  const float largest = std::max(a.largest, b.largest);
  const glm::vec3 d = b.centre - a.centre;
  const float length2 = d.x * d.x + d.y * d.y + d.z * d.z;
  if (!(largest < 1e18f && length2 > 1e-30f)) return std::nullopt;
  return Slab{d * (1 / std::sqrt(length2)), reach * (1 + 0x1p-19f) + largest * 0x1p-18f};
}

}  // namespace

Run GroupSearch::run(Index body) const {
  const Index first = frame_->bodies->first[body];
  return {frame_->x.data() + first, frame_->y.data() + first, frame_->z.data() + first, frame_->bodies->size(body)};
}

void GroupSearch::bound(const Frame& frame, Workers& workers, std::vector<Index>& non_finite_bodies) {
  frame_ = &frame;
  const Index bodies = frame.bodies->count();
  bounds_.resize(bodies);
  workers.run([&](int thread) {
    const Part part = part_of(bodies, thread, workers.threads());
    for (auto body = static_cast<Index>(part.begin); body < part.end; ++body) {
      if (frame.bodies->size(body) > 0) bounds_[body] = bound_of(run(body));
    }
  });
  live_.clear();
  non_finite_bodies.clear();
  for (Index body = 0; body < bodies; ++body) {
    if (frame.bodies->size(body) == 0) continue;
    (bounds_[body].finite ? live_ : non_finite_bodies).push_back(body);
  }
}

void GroupSearch::find(const Frame& frame, const Query& query, Workers& workers) {
  find_near(query.distance, workers);
  find_groups(frame, query, workers, [](Index) { return true; });
}

void GroupSearch::find_near(float distance, Workers& workers) {
  near_.find(bounds_, live_, contact_reach(distance), workers);
}

void GroupSearch::begin(const Frame& frame, const Query& query, Workers& workers) {
  frame_ = &frame;
  query_ = query;
  reach_ = contact_reach(query.distance);
  distance2_ = query.distance * query.distance;
  tolerance2_ = query.tolerance * query.tolerance;
  if (query.self) references_.update(frame, live_, reach_);
  threads_.resize(static_cast<std::size_t>(workers.threads()));
  slices_.resize(frame.bodies->count());
  found_ = 0;
}

void GroupSearch::begin(Thread& own) const {
  own.tree.begin(query_.levels, reach_, distance2_, query_.most_pairs);
  own.pairs.clear();
  own.partners.clear();
  own.counted = 0;
  own.self_contacts = own.pair_tests = own.parted = own.unfolded = 0;
}

void GroupSearch::find_group(int thread, Index a) {
  Thread& own = threads_[static_cast<std::size_t>(thread)];
  const std::size_t first_partner = own.partners.size();
  own.group.clear();
  if (query_.self) find_self(own, a);
  std::size_t runs = own.group.empty() ? 0 : 1;
  own.self_contacts += own.group.size();
  bool ordered = true;
  for (const Index b : near_.behind(a)) {
    const std::size_t before = own.group.size(), leaves = own.tree.leaves();
    find_between(own, a, b);
    if (own.group.size() > query_.most_pairs) throw_too_many_contacts(query_.most_pairs);
    if (own.group.size() == before) continue;
    own.partners.push_back(b);
    ++runs;
    ordered = ordered && own.tree.leaves() == leaves;
  }
  if (runs > 1 || !ordered) order(own, a, ordered);
  slices_[a] = {static_cast<Index>(thread), own.pairs.size(), own.pairs.size() + own.group.size(), first_partner,
                own.partners.size()};
  own.pairs.insert(own.pairs.end(), own.group.begin(), own.group.end());
  if (own.pairs.size() - own.counted >= std::min(most_pairs_between_counts, query_.most_pairs / 8)) count_pairs(own);
}

void GroupSearch::count_pairs(Thread& own) {
  const std::size_t added = own.pairs.size() - own.counted;
  own.counted = own.pairs.size();
  if (found_.fetch_add(added, std::memory_order_relaxed) + added > query_.most_pairs) {
    throw_too_many_contacts(query_.most_pairs);
  }
}

void GroupSearch::find_between(Thread& own, Index a, Index b) {
  const Run run_a = run(a), run_b = run(b);
  const Index first_a = frame_->bodies->first[a], first_b = frame_->bodies->first[b];
  if (const std::optional<Slab> slab = slab_between(bounds_[a], bounds_[b], reach_)) {
    const Facing facing =
        face(run_a, first_a, run_b, first_b, *slab, distance2_, OverlapTree::leaf_tests, own.facing, own.group);
    own.parted += facing.tests == 0;
    if (facing.done) {
      own.pair_tests += facing.tests;
      return;
    }
  } else {
    own.facing.near_a.take(run_a, first_a);
    own.facing.near_b.take(run_b, first_b);
  }
  own.tree.between(own.facing.near_a, own.facing.near_b, a, own.group);
}

void GroupSearch::find_self(Thread& own, Index body) {
  const Index first = frame_->bodies->first[body];
  const Run vertices = run(body);
  const SelfReference* reference = references_.of(body);
  const SelfRisk risk = reference ? reference->at_risk(vertices, bounds_[body], own.self) : SelfRisk{};
  if (!risk.proven) {
    own.whole.take(vertices, first);
    own.tree.within(own.whole, body, own.group);
  }
  for (const auto& [i, j] : risk.pairs) {
    if (squared_distance(vertices.x[i], vertices.y[i], vertices.z[i], vertices.x[j], vertices.y[j], vertices.z[j]) <
        distance2_) {
      own.group.push_back({first + i, first + j});
    }
  }
  for (const Index odd : risk.odd) contacts_of(vertices, first, odd, distance2_, own.words, own.group);
  own.unfolded += risk.proven && risk.odd.empty();
  own.pair_tests += risk.pairs.size() + std::uint64_t{risk.odd.size()} * (vertices.size - 1);
  if (!own.group.empty()) tidy_self(own, body);
}

/// Brings the pairs into order, each once, and leaves out those that can never be contacts.
void GroupSearch::tidy_self(Thread& own, Index body) {
  const Index first = frame_->bodies->first[body];
  const Shape& shape = *frame_->bodies->shape[body];
  std::erase_if(own.group, [&](Contact& pair) {
    if (pair.a > pair.b) std::swap(pair.a, pair.b);
    return shape.excludes(pair.a - first, pair.b - first, tolerance2_);
  });
  std::sort(own.group.begin(), own.group.end());
  own.group.erase(std::unique(own.group.begin(), own.group.end()), own.group.end());
}

/// Sorts a group. If each of its runs is ordered and they come by their second body, it takes a stable sort by the
/// first vertex: counting, unless the body has far more vertices than contacts.
void GroupSearch::order(Thread& own, Index a, bool runs_ordered) {
  const Index first = frame_->bodies->first[a], size = frame_->bodies->size(a);
  if (!runs_ordered || own.group.size() < size / 16) {
    std::sort(own.group.begin(), own.group.end());
    return;
  }
  own.vertex_count.assign(size, 0);
  for (const Contact& contact : own.group) ++own.vertex_count[contact.a - first];
  Index end = 0;
  for (Index& count : own.vertex_count) end += std::exchange(count, end);
  own.sorted.resize(own.group.size());
  for (const Contact& contact : own.group) own.sorted[own.vertex_count[contact.a - first]++] = contact;
  own.group.swap(own.sorted);
}

std::span<const Contact> GroupSearch::group(Index body) const {
  const Slice& slice = slices_[body];
  return std::span(threads_[slice.thread].pairs).subspan(slice.begin, slice.end - slice.begin);
}

std::span<const Index> GroupSearch::partners(Index body) const {
  const Slice& slice = slices_[body];
  return std::span(threads_[slice.thread].partners)
      .subspan(slice.first_partner, slice.last_partner - slice.first_partner);
}

void GroupSearch::concatenate(Workers& workers, std::vector<Contact>& pairs) {
  std::size_t total = 0;
  for (Thread& thread : threads_)
    thread.counted = std::exchange(total, total + thread.pairs.size());  // its first place
  pairs.resize(total);
  workers.run([&](int thread) {
    const Thread& own = threads_[static_cast<std::size_t>(thread)];
    std::copy(own.pairs.begin(), own.pairs.end(), pairs.begin() + static_cast<std::ptrdiff_t>(own.counted));
  });
}

void GroupSearch::count(Result& result) const {
  for (const Thread& thread : threads_) {
    result.self_contacts += thread.self_contacts;
    result.counters.pair_tests += thread.pair_tests + thread.tree.pair_tests();
    result.counters.boxes += thread.tree.leaves();
    result.skip(Skip::separated_pairs) += thread.parted;
    result.skip(Skip::unfolded_bodies) += thread.unfolded;
  }
  const std::uint64_t live = live_.size();
  result.counters.boxes += live;
  result.skip(Skip::far_pairs) += live * (live - std::min<std::uint64_t>(live, 1)) / 2 - near_.near_boxes();
  result.skip(Skip::separated_pairs) += near_.near_boxes() - near_.pairs();
  result.skip(Skip::lone_bodies) += near_.alone();
}

std::vector<DebugGeometry::Box> GroupSearch::boxes() const {
  std::vector<DebugGeometry::Box> boxes;
  for (const Index a : live_) {
    for (const Index b : near_.behind(a)) {
      const Aabb &one = bounds_[a].box, &other = bounds_[b].box;
      const float half = reach_ / 2;
      boxes.push_back({glm::max(one.lo, other.lo) - half, glm::min(one.hi, other.hi) + half, a});
    }
  }
  for (const Thread& thread : threads_) {
    const auto& leaves = thread.tree.leaves_list();
    boxes.insert(boxes.end(), leaves.begin(), leaves.end());
  }
  return boxes;
}

}  // namespace collide
