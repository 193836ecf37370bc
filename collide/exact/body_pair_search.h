#pragma once
// Finds all contacts of a frame, body by body, except that all threads share the pairs that are found by patches. The
// group of a body holds every contact whose first vertex belongs to the body. The groups one after another are all
// contacts of the frame in their order.

#include <atomic>

#include "collide/core/contact_sort.h"
#include "collide/exact/body_broad_phase.h"
#include "collide/exact/pair_kernels.h"
#include "collide/exact/patch_search.h"
#include "collide/exact/resting_contacts.h"
#include "collide/exact/self_collision_culling.h"

namespace collide::exact {

class BodyPairSearch {
 public:
  /// Computes bounds() of the frame's bodies. Lists the bodies with a coordinate that is not finite; these have no
  /// group.
  void find_bounds(const Frame& frame, Workers& workers, std::vector<Index>& non_finite_bodies);

  std::span<const BodyBounds> bounds() const { return bounds_; }

  /// Runs the broad phase, then finds all groups except those that `resting` has kept. Call find_bounds() and
  /// resting.observe() on the same frame before. Throws std::length_error at more than contact_limit contacts.
  void find(const Frame& frame, const Settings& settings, const RestingContacts& resting, Workers& workers);

  const BodyBroadPhase& near() const { return near_; }

  /// Copies all groups, one after another, into `pairs`.
  void concatenate(Workers& workers, std::vector<Contact>& pairs);

  /// Adds the counters of the last search, and what it left out, to the result.
  void count(Result& result) const;
  /// Returns the areas where bodies overlap and the boxes of patches, for drawing.
  std::vector<DebugGeometry::Box> boxes() const;

  void forget() {
    references_.forget();
    patches_.forget();
  }

 private:
  struct alignas(64) Thread {
    std::unique_ptr<FacingScratch> facing;  // null until it is needed
    CullingReference::Scratch self;
    PatchSearch::Scratch patches;
    std::vector<Contact> pairs;  // of its groups, in order
    std::vector<Contact> loose;  // of loose groups, in no order
    std::size_t checked = 0;     // how many of both are counted in found_
    std::size_t place = 0;       // of its pairs among those of all threads
    std::vector<Contact> group;
    ContactSort sort;
    std::vector<Index> close;  // to one vertex
    std::uint64_t self_contacts = 0, pair_tests = 0, separated = 0, unfolded = 0, kept = 0;
  };

  void begin(const Frame& frame, const Settings& settings);
  void begin(Thread& own) const;
  /// Returns whether all threads share the search inside a body, or between two: one is large.
  bool is_shared(Index a, Index b) const {
    return std::max(frame_->bodies->size(a), frame_->bodies->size(b)) > FacingScratch::max_vertices;
  }
  void deal(const RestingContacts& resting, Workers& workers);
  /// Finds one thread's share of these contacts.
  void find_patch_contacts(int thread, int threads);
  /// Finds the groups of one thread's share of the bodies. Each thread gets consecutive bodies, with about as many near
  /// pairs as every other thread.
  void find_part(int thread, int threads, const RestingContacts& resting);
  void find_group(Thread& own, Index a);
  void keep_group(Thread& own, Index a, std::span<const Contact> group);
  void find_between(Thread& own, Index a, Index b);
  void find_by_patches(Thread& own, Index a, Index b);
  void find_self(Thread& own, Index body);
  void sort_self_contacts(Thread& own, Index body);
  void check_contact_limit(Thread& own);

  const Frame* frame_ = nullptr;
  bool self_collision_ = true;
  float cutoff_ = 0, tolerance2_ = 0;
  std::vector<BodyBounds> bounds_;  // of every body
  std::vector<Index> live_;
  BodyBroadPhase near_;
  SelfCollisionCulling references_;
  std::vector<std::array<Index, 2>> shared_;  // pairs of bodies that is_shared(), without groups that are kept
  std::vector<Index> loose_;                  // their first bodies: the contacts of these groups come in no order
  PatchSearch patches_;
  std::size_t patch_tasks_ = 0;  // of this frame
  ContactSort sort_;
  std::vector<Contact> merged_;
  std::vector<Thread> threads_;
  std::atomic<std::size_t> found_ = 0;
};

}  // namespace collide::exact
