// Sweep and prune: the boxes of the bodies sorted along the axis of greatest spread, and then, for two near bodies and
// inside each body, those of patches of vertices along the same axis.

#include <algorithm>

#include <glm/common.hpp>

#include "collide/core/body_boxes.h"
#include "collide/core/contact_search.h"
#include "collide/core/cutoff.h"
#include "collide/methods/detectors.h"
#include "collide/trees/body_trees.h"

namespace collide::methods {

namespace {

struct Patch {
  Aabb box;
  Range slots;
};

class SweepAndPrune final : public Detector {
 public:
  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    bodies_.build(frame, result);
    cutoff_ = contact_cutoff(settings.tolerance);
    trees_.update(frame, bodies_.live, workers);
    sort_patches(frame, workers);
    result.counters.boxes = bodies_.live.size() + patches_.size();
    const std::vector<BodyPair>& pairs = pairs_.find(bodies_, cutoff_);
    const int parts = workers.threads_for(sweep_ns * trees_.points().size());
    search_.begin(frame, settings, trees_.points(), parts);
    threads_.resize(static_cast<std::size_t>(parts));
    workers.share(parts, pairs.size(), [&](int thread, std::size_t k) { sweep_between(thread, pairs[k]); });
    if (settings.self_collision)
      workers.share(parts, bodies_.live.size(),
                    [&](int thread, std::size_t k) { sweep_within(thread, patches_of(bodies_.live[k])); });
    search_.finish(result);
  }

  void forget() override { trees_.forget(); }

 private:
  static constexpr double sort_ns = 10, sweep_ns = 30;  // of work, of a vertex
  struct alignas(64) Thread {
    std::vector<Patch> near_a, near_b;
  };

  std::span<const Patch> patches_of(Index body) const {
    return std::span(patches_).subspan(first_patch_[body], end_patch_[body] - first_patch_[body]);
  }

  /// Lists the patches of each body in the order in which they begin along the axis.
  void sort_patches(const Frame& frame, Workers& workers) {
    first_patch_.resize(frame.bodies->count());
    end_patch_.resize(frame.bodies->count());
    glm::vec3 least(0), most(0);
    Index patches = 0;
    for (std::size_t k = 0; k < bodies_.live.size(); ++k) {
      const Index body = bodies_.live[k];
      least = k == 0 ? bodies_.box[body].lo : glm::min(least, bodies_.box[body].lo);
      most = k == 0 ? bodies_.box[body].lo : glm::max(most, bodies_.box[body].lo);
      first_patch_[body] = patches;
      patches += static_cast<Index>(trees_.nodes_of(k).size() + 1) / 2;  // the leaves of a binary tree
      end_patch_[body] = patches;
    }
    axis_ = longest_axis(most * 0.5f - least * 0.5f);
    patches_.resize(patches);
    const int parts = workers.threads_for(sort_ns * trees_.points().size());
    workers.share(parts, bodies_.live.size(), [&](int, std::size_t k) {
      Patch *const first = &patches_[first_patch_[bodies_.live[k]]], *next = first;
      for (const trees::Node& node : trees_.nodes_of(k)) {
        if (node.is_leaf()) *next++ = {node.box, node.slots()};
      }
      std::sort(first, next, [this](const Patch& a, const Patch& b) { return a.box.lo[axis_] < b.box.lo[axis_]; });
    });
  }

  void sweep_within(int thread, std::span<const Patch> patches) {
    for (std::size_t i = 0; i < patches.size(); ++i) {
      search_.test(thread, patches[i].slots, patches[i].slots);
      sweep_from(thread, patches[i], patches.subspan(i + 1));
    }
  }

  void sweep_between(int thread, const BodyPair& pair) {
    Thread& own = threads_[static_cast<std::size_t>(thread)];
    pick_near(patches_of(pair.a), bodies_.box[pair.b], own.near_a);
    pick_near(patches_of(pair.b), bodies_.box[pair.a], own.near_b);
    std::span<const Patch> a = own.near_a, b = own.near_b;
    while (!a.empty() && !b.empty()) {
      const bool a_begins = a.front().box.lo[axis_] <= b.front().box.lo[axis_];
      std::span<const Patch>&begins = a_begins ? a : b, &others = a_begins ? b : a;
      sweep_from(thread, begins.front(), others);
      begins = begins.subspan(1);
    }
  }

  void pick_near(std::span<const Patch> patches, const Aabb& box, std::vector<Patch>& picked) const {
    picked.clear();
    std::ranges::copy_if(patches, std::back_inserter(picked),
                         [&](const Patch& patch) { return near(patch.box, box, cutoff_); });
  }

  /// Tests a patch against those of others that are near it. All of them begin where it begins, or later.
  void sweep_from(int thread, const Patch& patch, std::span<const Patch> others) {
    for (const Patch& other : others) {
      if (other.box.lo[axis_] - patch.box.hi[axis_] > cutoff_) break;
      if (near(patch.box, other.box, cutoff_)) search_.test(thread, patch.slots, other.slots, other.box);
    }
  }

  BodyBoxes bodies_;
  BodyPairs pairs_;
  trees::BodyTrees trees_;
  float cutoff_ = 0;
  int axis_ = 0;
  std::vector<Patch> patches_;                  // body by body
  std::vector<Index> first_patch_, end_patch_;  // by body
  std::vector<Thread> threads_;
  ContactSearch search_;
};

}  // namespace

std::unique_ptr<Detector> make_sweep_and_prune() { return std::make_unique<SweepAndPrune>(); }

}  // namespace collide::methods
