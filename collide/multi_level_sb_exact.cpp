// Multi-Level SB Collide made exact, and kept to where bodies can touch. Of every two bodies whose boxes (§2.1) and
// spheres come near each other, only the vertices that face the other body along the line of centres are looked at; the
// area that they fill is subdivided level by level (§5) as long as that pays. Inside a body all pairs are looked at, by
// the same tree, unless it is proven that it cannot touch itself. No hash: what is near a body is found by sweep.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "collide/detectors.h"
#include "collide/near_bodies.h"
#include "collide/overlap_tree.h"
#include "collide/reach.h"
#include "collide/self_proof.h"

namespace collide {

namespace {

constexpr std::size_t max_contacts = std::size_t{1} << 27;  // 1 GiB of them
constexpr std::size_t contacts_between_counts = 1u << 16;   // of one thread

/// See Slab. With u = 2^-24, a projection errs by at most 7u of the largest coordinate, the sum with the reach by 3u of
/// it, and the normal is longer than 1 by a few u. Nothing where squares could overflow or underflow.
std::optional<Slab> slab_between(const Bound& a, const Bound& b, float reach) {
  const float largest = std::max(a.largest, b.largest);
  const glm::vec3 d = b.centre - a.centre;
  const float length2 = d.x * d.x + d.y * d.y + d.z * d.z;
  if (!(largest < 1e18f && length2 > 1e-30f)) return std::nullopt;
  return Slab{d * (1 / std::sqrt(length2)), reach * (1 + 0x1p-19f) + largest * 0x1p-18f};
}

class MultiLevelSbExact final : public Detector {
 public:
  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    frame_ = &frame;
    settings_ = settings;
    reach_ = contact_reach(settings.tolerance);
    tolerance2_ = settings.tolerance * settings.tolerance;
    result.self_contacts = 0;
    result.counters = {};
    result.skipped = {};
    result.coverage = Coverage::exact;
    bound_bodies(workers, result);
    near_.find(bounds_, live_, reach_, workers);
    threads_.resize(static_cast<std::size_t>(workers.threads()));
    if (settings.self_collision) self_.update(frame, live_, reach_);
    found_ = 0;
    workers.run([&](int thread) { find_contacts(thread, workers.threads()); });
    gather(workers, result);
  }

  void forget() override { self_.forget(); }

  DebugGeometry debug() const override {
    DebugGeometry geometry;
    for (const Index a : live_) {
      for (const Index b : near_.behind(a)) {
        const Aabb &one = bounds_[a].box, &other = bounds_[b].box;
        glm::vec3 lo, hi;
        for (int axis = 0; axis < 3; ++axis) {
          lo[axis] = std::max(one.lo[axis], other.lo[axis]) - reach_ / 2;
          hi[axis] = std::min(one.hi[axis], other.hi[axis]) + reach_ / 2;
        }
        geometry.boxes.push_back({lo, hi, a});
      }
    }
    for (const Thread& thread : threads_) {
      const auto& leaves = thread.tree.leaves_list();
      geometry.boxes.insert(geometry.boxes.end(), leaves.begin(), leaves.end());
    }
    geometry.box_first.assign(geometry.boxes.size() + 1, 0);
    return geometry;
  }

 private:
  struct alignas(64) Thread {
    OverlapTree tree;
    FacingScratch facing;
    SelfReference::Scratch self;
    Words words;
    Picked whole;                   // of one body
    std::vector<Contact> contacts;  // in their final order
    std::size_t counted = 0;        // of them, in found_
    std::vector<Contact> group, sorted;
    std::vector<Index> count;
    std::uint64_t self_contacts = 0, pair_tests = 0, parted = 0, unfolded = 0;
  };

  Run run(Index body) const {
    const Index first = frame_->bodies->first[body];
    return {frame_->x.data() + first, frame_->y.data() + first, frame_->z.data() + first, frame_->bodies->size(body)};
  }

  void bound_bodies(Workers& workers, Result& result) {
    const Index bodies = frame_->bodies->count();
    bounds_.resize(bodies);
    workers.run([&](int thread) {
      const Part part = part_of(bodies, thread, workers.threads());
      for (auto body = static_cast<Index>(part.begin); body < part.end; ++body) {
        if (frame_->bodies->size(body) > 0) bounds_[body] = bound_of(run(body));
      }
    });
    live_.clear();
    result.non_finite_bodies.clear();
    for (Index body = 0; body < bodies; ++body) {
      if (frame_->bodies->size(body) == 0) continue;
      (bounds_[body].finite ? live_ : result.non_finite_bodies).push_back(body);
    }
  }

  /// Each thread takes consecutive bodies with about the same number of pairs, and each body's pairs with those behind.
  void find_contacts(int thread, int threads) {
    Thread& own = threads_[static_cast<std::size_t>(thread)];
    own.tree.begin(settings_.levels, reach_, tolerance2_);
    own.contacts.clear();
    own.counted = 0;
    own.self_contacts = own.pair_tests = own.parted = own.unfolded = 0;
    const std::size_t work = near_.pairs() + live_.size();
    const Part part = part_of(work, thread, threads);
    for (std::size_t k = 0; k < live_.size(); ++k) {
      const std::size_t place = near_.pairs_before(live_[k]) + k;
      if (place >= part.begin && place < part.end) find_group(own, live_[k]);
    }
  }

  /// All contacts whose first vertex is the body's.
  void find_group(Thread& own, Index a) {
    own.group.clear();
    if (settings_.self_collision) find_self(own, a);
    std::size_t runs = own.group.empty() ? 0 : 1;
    own.self_contacts += own.group.size();
    bool ordered = true;
    for (const Index b : near_.behind(a)) {
      const std::size_t before = own.group.size(), leaves = own.tree.leaves();
      find_between(own, a, b);
      runs += own.group.size() > before;
      ordered = ordered && own.tree.leaves() == leaves;
    }
    if (runs > 1 || !ordered) order(own, a, ordered);
    own.contacts.insert(own.contacts.end(), own.group.begin(), own.group.end());
    if (own.contacts.size() - own.counted >= contacts_between_counts) count_contacts(own);
  }

  void count_contacts(Thread& own) {
    const std::size_t added = own.contacts.size() - own.counted;
    own.counted = own.contacts.size();
    if (found_.fetch_add(added, std::memory_order_relaxed) + added > max_contacts) {
      throw std::length_error("more than 134217728 contacts in one frame: lower the tolerance");
    }
  }

  void find_between(Thread& own, Index a, Index b) {
    const Run run_a = run(a), run_b = run(b);
    const Index first_a = frame_->bodies->first[a], first_b = frame_->bodies->first[b];
    if (const std::optional<Slab> slab = slab_between(bounds_[a], bounds_[b], reach_)) {
      const Facing facing =
          face(run_a, first_a, run_b, first_b, *slab, tolerance2_, OverlapTree::leaf_tests, own.facing, own.group);
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

  void find_self(Thread& own, Index body) {
    const Index first = frame_->bodies->first[body];
    const Run vertices = run(body);
    const SelfReference* reference = self_.of(body);
    const SelfRisk risk = reference ? reference->at_risk(vertices, bounds_[body], own.self) : SelfRisk{};
    if (!risk.proven || !risk.odd.empty()) own.whole.take(vertices, first);
    if (!risk.proven) own.tree.within(own.whole, body, own.group);
    for (const auto& [i, j] : risk.pairs) {
      if (squared_distance(vertices.x[i], vertices.y[i], vertices.z[i], vertices.x[j], vertices.y[j], vertices.z[j]) <
          tolerance2_) {
        own.group.push_back({first + i, first + j});
      }
    }
    for (const Index odd : risk.odd) contacts_of(own.whole, odd, tolerance2_, own.words, own.group);
    own.unfolded += risk.proven && risk.odd.empty();
    own.pair_tests += risk.pairs.size() + std::uint64_t{risk.odd.size()} * (vertices.size - 1);
    if (!own.group.empty()) tidy_self(own, body);
  }

  /// Brings the pairs into order, each once, and leaves out those that can never be contacts.
  void tidy_self(Thread& own, Index body) {
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
  void order(Thread& own, Index a, bool runs_ordered) {
    const Index first = frame_->bodies->first[a], size = frame_->bodies->size(a);
    if (!runs_ordered || own.group.size() < size / 16) {
      std::sort(own.group.begin(), own.group.end());
      return;
    }
    own.count.assign(size, 0);
    for (const Contact& contact : own.group) ++own.count[contact.a - first];
    Index end = 0;
    for (Index& count : own.count) end += std::exchange(count, end);
    own.sorted.resize(own.group.size());
    for (const Contact& contact : own.group) own.sorted[own.count[contact.a - first]++] = contact;
    own.group.swap(own.sorted);
  }

  void gather(Workers& workers, Result& result) {
    std::size_t total = 0;
    std::vector<std::size_t>& begin = begin_;
    begin.clear();
    for (const Thread& thread : threads_) {
      begin.push_back(total);
      total += thread.contacts.size();
      result.self_contacts += thread.self_contacts;
      result.counters.pair_tests += thread.pair_tests + thread.tree.pair_tests();
      result.counters.boxes += thread.tree.leaves();
      skip(result, Skip::separated_pairs) += thread.parted;
      skip(result, Skip::unfolded_bodies) += thread.unfolded;
    }
    result.contacts.resize(total);
    workers.run([&](int thread) {
      const auto t = static_cast<std::size_t>(thread);
      std::copy(threads_[t].contacts.begin(), threads_[t].contacts.end(),
                result.contacts.begin() + static_cast<std::ptrdiff_t>(begin[t]));
    });
    const std::uint64_t live = live_.size();
    result.counters.boxes += live;
    skip(result, Skip::far_pairs) = live * (live - std::min<std::uint64_t>(live, 1)) / 2 - near_.near_boxes();
    skip(result, Skip::separated_pairs) += near_.near_boxes() - near_.pairs();
    skip(result, Skip::lone_bodies) = near_.alone();
  }

  static std::uint64_t& skip(Result& result, Skip kind) { return result.skipped[static_cast<std::size_t>(kind)]; }

  const Frame* frame_ = nullptr;
  Settings settings_;
  float reach_ = 0, tolerance2_ = 0;
  std::vector<Bound> bounds_;  // of every body
  std::vector<Index> live_;    // bodies with vertices, all of them finite; ascending
  NearBodies near_;
  SelfReferences self_;
  std::vector<Thread> threads_;
  std::vector<std::size_t> begin_;
  std::atomic<std::size_t> found_ = 0;
};

}  // namespace

std::unique_ptr<Detector> make_multi_level_sb_exact() { return std::make_unique<MultiLevelSbExact>(); }

}  // namespace collide
