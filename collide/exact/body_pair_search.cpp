#include "collide/exact/body_pair_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

#include "collide/core/cutoff.h"

namespace collide::exact {

namespace {

constexpr std::size_t max_uncounted_pairs = 1u << 16;  // of one thread

// Of work: the bounds of a vertex; two near bodies, a body, a vertex of a shared body; a contact in its order.
constexpr double bounds_ns = 1, pair_ns = 100, body_ns = 50, patch_ns = 30, contact_ns = 10;

/// See Slab. With u = 2^-24, a projection errs by at most 7u of the largest coordinate, the sum with the cutoff by 3u
/// of it, and the normal is longer than 1 by a few u. Separates nothing where squares could overflow or underflow.
Slab slab_between(const BodyBounds& a, const BodyBounds& b, float cutoff) {
  const float largest = std::max(a.largest, b.largest);
  const glm::vec3 d = b.centre - a.centre;
  const float length2 = d.x * d.x + d.y * d.y + d.z * d.z;
  if (!(largest < 1e18f && length2 > 1e-30f)) return {glm::vec3(0), cutoff};
  return {d * (1 / std::sqrt(length2)), cutoff * (1 + 0x1p-19f) + largest * 0x1p-18f};
}

}  // namespace

void BodyPairSearch::find_bounds(const Frame& frame, Workers& workers, std::vector<Index>& non_finite_bodies) {
  assert(is_complete(frame));
  frame_ = &frame;
  const Index bodies = frame.bodies->count();
  bounds_.resize(bodies);
  const int parts = workers.threads_for(bounds_ns * static_cast<double>(frame.bodies->vertex_count()));
  workers.run(parts, [&](int number) {
    const Part part = part_of(bodies, number, parts);
    for (auto body = static_cast<Index>(part.begin); body < part.end; ++body) {
      if (frame.bodies->size(body) > 0) bounds_[body] = measure_bounds(vertices_of(*frame_, body));
    }
  });
  live_.clear();
  non_finite_bodies.clear();
  for (Index body = 0; body < bodies; ++body) {
    if (frame.bodies->size(body) == 0) continue;
    (bounds_[body].finite ? live_ : non_finite_bodies).push_back(body);
  }
}

void BodyPairSearch::find(const Frame& frame, const Settings& settings, const RestingContacts& resting,
                          Workers& workers) {
  assert(bounds_.size() == frame.bodies->count());
  begin(frame, settings);
  near_.find(bounds_, live_, cutoff_, workers);
  deal(resting, workers);
  const auto parts = static_cast<int>(threads_.size());
  workers.run(parts, [&](int part) {
    Thread& own = threads_[static_cast<std::size_t>(part)];
    begin(own);
    find_patch_contacts(part, parts);
    find_part(part, parts, resting);
  });
  for (Thread& thread : threads_)
    check_contact_limit(thread);  // the rest: no more may pass on many threads than on one
}

void BodyPairSearch::begin(const Frame& frame, const Settings& settings) {
  frame_ = &frame;
  self_collision_ = settings.self_collision;
  cutoff_ = contact_cutoff(settings.tolerance);
  tolerance2_ = settings.tolerance * settings.tolerance;
  if (self_collision_) references_.update(frame, live_, cutoff_);
  patches_.begin(tolerance2_, cutoff_);
  found_ = 0;
}

void BodyPairSearch::begin(Thread& own) const {
  own.pairs.clear();
  own.loose.clear();
  own.patches.boxes.clear();
  own.checked = 0;
  own.self_contacts = own.pair_tests = own.separated = own.unfolded = own.kept = 0;
}

/// Decides in how many parts the search is cut, and deals what threads share.
void BodyPairSearch::deal(const RestingContacts& resting, Workers& workers) {
  shared_.clear();
  loose_.clear();
  double work = pair_ns * static_cast<double>(near_.pairs()) + body_ns * static_cast<double>(live_.size());
  const bool any =
      std::ranges::any_of(live_, [&](Index body) { return frame_->bodies->size(body) > FacingScratch::max_vertices; });
  for (const Index a : any ? std::span<const Index>(live_) : std::span<const Index>()) {
    if (resting.group(a, near_)) continue;
    const std::size_t before = shared_.size();
    if (self_collision_ && is_shared(a, a)) shared_.push_back({a, a});
    for (const Index b : near_.later_neighbours(a))
      if (is_shared(a, b)) shared_.push_back({a, b});
    if (shared_.size() == before) continue;
    loose_.push_back(a);
    work += patch_ns * frame_->bodies->size(a);
  }
  const int parts = workers.threads_for(work);
  threads_.resize(static_cast<std::size_t>(parts));
  patch_tasks_ = shared_.empty() ? 0 : patches_.take(*frame_, shared_, parts, workers);
}

void BodyPairSearch::find_patch_contacts(int thread, int threads) {
  Thread& own = threads_[static_cast<std::size_t>(thread)];
  for (auto task = static_cast<std::size_t>(thread); task < patch_tasks_; task += static_cast<std::size_t>(threads)) {
    const PatchSearch::Found found = patches_.find(task, contact_limit, own.patches, own.loose);
    own.pair_tests += found.pair_tests;
    own.self_contacts += found.self_contacts;
    check_contact_limit(own);
  }
}

void BodyPairSearch::find_part(int thread, int threads, const RestingContacts& resting) {
  Thread& own = threads_[static_cast<std::size_t>(thread)];
  const Part part = part_of(near_.pairs() + live_.size(), thread, threads);
  for (std::size_t k = 0; k < live_.size(); ++k) {
    const Index body = live_[k];
    const std::size_t place = near_.pairs_before(body) + k;
    if (place < part.begin || place >= part.end) continue;
    if (const auto group = resting.group(body, near_)) {
      keep_group(own, body, *group);
    } else {
      find_group(own, body);
    }
    if (own.pairs.size() + own.loose.size() - own.checked >= std::min(max_uncounted_pairs, contact_limit / 8))
      check_contact_limit(own);
  }
}

void BodyPairSearch::keep_group(Thread& own, Index a, std::span<const Contact> group) {
  const Index end = frame_->bodies->first[a + 1];
  own.self_contacts += static_cast<std::uint64_t>(
      std::count_if(group.begin(), group.end(), [end](const Contact& contact) { return contact.b < end; }));
  own.kept += near_.later_neighbours(a).size();
  own.pairs.insert(own.pairs.end(), group.begin(), group.end());
}

/// Of a loose group, finds what threads do not share.
void BodyPairSearch::find_group(Thread& own, Index a) {
  own.group.clear();
  if (self_collision_ && !is_shared(a, a)) find_self(own, a);
  own.self_contacts += own.group.size();
  std::size_t runs = own.group.empty() ? 0 : 1;
  for (const Index b : near_.later_neighbours(a)) {
    if (is_shared(a, b)) continue;
    const std::size_t before = own.group.size();
    find_between(own, a, b);
    if (own.group.size() > contact_limit) throw_too_many_contacts(contact_limit);
    runs += own.group.size() != before;
  }
  const bool loose = std::ranges::binary_search(loose_, a);
  if (runs > 1 && !loose) own.sort.sort_by_first(own.group, {frame_->bodies->first[a], frame_->bodies->first[a + 1]});
  std::vector<Contact>& to = loose ? own.loose : own.pairs;
  to.insert(to.end(), own.group.begin(), own.group.end());
}

void BodyPairSearch::check_contact_limit(Thread& own) {
  const std::size_t added = own.pairs.size() + own.loose.size() - own.checked;
  own.checked += added;
  if (found_.fetch_add(added, std::memory_order_relaxed) + added > contact_limit) {
    throw_too_many_contacts(contact_limit);
  }
}

void BodyPairSearch::find_between(Thread& own, Index a, Index b) {
  const VertexRun run_a = vertices_of(*frame_, a), run_b = vertices_of(*frame_, b);
  const Index first_a = frame_->bodies->first[a], first_b = frame_->bodies->first[b];
  const Slab slab = slab_between(bounds_[a], bounds_[b], cutoff_);
  if (!own.facing) own.facing = std::make_unique_for_overwrite<FacingScratch>();
  const Index facing = find_facing_contacts(run_a, first_a, run_b, first_b, slab, tolerance2_, *own.facing, own.group);
  own.separated += facing == 0;
  if (facing <= FacingScratch::max_tests) {
    own.pair_tests += facing;
  } else {
    find_by_patches(own, a, b);
  }
}

void BodyPairSearch::find_by_patches(Thread& own, Index a, Index b) {
  const auto before = static_cast<std::ptrdiff_t>(own.group.size());
  own.pair_tests += patches_.find(*frame_, a, b, contact_limit, own.patches, own.group).pair_tests;
  std::sort(own.group.begin() + before, own.group.end());
}

void BodyPairSearch::find_self(Thread& own, Index body) {
  const Index first = frame_->bodies->first[body];
  const VertexRun vertices = vertices_of(*frame_, body);
  const CullingReference* reference = references_.of(body);
  const SelfCollisionCandidates risk =
      reference ? reference->candidates_of(vertices, bounds_[body], own.self) : SelfCollisionCandidates{};
  if (!risk.culled) {
    find_by_patches(own, body, body);
    return;
  }
  for (const auto& [i, j] : risk.pairs) {
    if (squared_distance(vertices.x[i], vertices.y[i], vertices.z[i], vertices.x[j], vertices.y[j], vertices.z[j]) <
        tolerance2_) {
      own.group.push_back({first + i, first + j});
    }
  }
  for (const Index outlier : risk.outliers) contacts_of(vertices, first, outlier, tolerance2_, own.close, own.group);
  own.unfolded += risk.outliers.empty();
  own.pair_tests += risk.pairs.size() + std::uint64_t{risk.outliers.size()} * (vertices.size - 1);
  if (!own.group.empty()) sort_self_contacts(own, body);
}

/// Brings the pairs into order, each once, and leaves out those that can never be contacts.
void BodyPairSearch::sort_self_contacts(Thread& own, Index body) {
  const Index first = frame_->bodies->first[body];
  const Shape& shape = *frame_->bodies->shape[body];
  std::erase_if(own.group, [&](Contact& pair) {
    if (pair.a > pair.b) std::swap(pair.a, pair.b);
    return shape.excludes(pair.a - first, pair.b - first, tolerance2_);
  });
  std::sort(own.group.begin(), own.group.end());
  own.group.erase(std::unique(own.group.begin(), own.group.end()), own.group.end());
}

void BodyPairSearch::concatenate(Workers& workers, std::vector<Contact>& pairs) {
  std::size_t total = 0;
  for (Thread& thread : threads_) thread.place = std::exchange(total, total + thread.pairs.size());
  pairs.resize(total);
  const int threads = workers.threads_for(contact_ns * static_cast<double>(found_.load()));
  workers.share(threads, threads_.size(), [&](int, std::size_t part) {
    const Thread& own = threads_[part];
    std::ranges::copy(own.pairs, pairs.begin() + static_cast<std::ptrdiff_t>(own.place));
  });
  if (loose_.empty()) return;
  std::vector<Contact>& loose = threads_.front().loose;
  for (const Thread& thread : std::span(threads_).subspan(1))
    loose.insert(loose.end(), thread.loose.begin(), thread.loose.end());
  sort_.sort(loose, {0, frame_->bodies->vertex_count()});
  merged_.resize(pairs.size() + loose.size());
  std::ranges::merge(pairs, loose, merged_.begin());
  pairs.swap(merged_);
}

void BodyPairSearch::count(Result& result) const {
  for (const Thread& thread : threads_) {
    result.self_contacts += thread.self_contacts;
    result.counters.pair_tests += thread.pair_tests;
    result.counters.boxes += thread.patches.boxes.size();
    result.skip(Skip::separated_pairs) += thread.separated;
    result.skip(Skip::unfolded_bodies) += thread.unfolded;
    result.skip(Skip::kept_pairs) += thread.kept;
  }
  const std::uint64_t live = live_.size();
  result.counters.boxes += live + patches_.patches();
  result.skip(Skip::far_pairs) += live * (live - std::min<std::uint64_t>(live, 1)) / 2 - near_.near_box_pairs();
  result.skip(Skip::separated_pairs) += near_.near_box_pairs() - near_.pairs();
  result.skip(Skip::lone_bodies) += near_.isolated_bodies();
}

std::vector<DebugGeometry::Box> BodyPairSearch::boxes() const {
  std::vector<DebugGeometry::Box> boxes;
  for (const Index a : live_) {
    for (const Index b : near_.later_neighbours(a)) {
      const Aabb &one = bounds_[a].box, &other = bounds_[b].box;
      const float half = cutoff_ / 2;
      boxes.push_back({glm::max(one.lo, other.lo) - half, glm::min(one.hi, other.hi) + half, a});
    }
  }
  for (const Thread& thread : threads_)
    boxes.insert(boxes.end(), thread.patches.boxes.begin(), thread.patches.boxes.end());
  patches_.add_boxes(boxes);
  return boxes;
}

}  // namespace collide::exact
