#pragma once
// The work of a frame, body by body: the group of a body is every contact whose first vertex is the body's. All
// contacts of the frame, in their order, are the groups one after another.

#include <atomic>

#include "collide/exact/body_broad_phase.h"
#include "collide/exact/overlap_tree.h"
#include "collide/exact/resting_contacts.h"
#include "collide/exact/self_collision_culling.h"

namespace collide::exact {

class BodyPairSearch {
 public:
  struct Query {
    float tolerance;  // m
    bool self;        // also pairs within bodies
    int levels;       // of cuts of the area where two bodies, or one and itself, overlap
    std::size_t most_pairs;
  };

  /// Finds where the bodies are, and names those that are not finite: they are in no group.
  void bound(const Frame& frame, Workers& workers, std::vector<Index>& non_finite_bodies);

  std::span<const Bound> bounds() const { return bounds_; }

  /// Finds the bodies near each other, then all groups but those that `resting`, which has observed the frame, has
  /// kept. After bound() of the same frame. Throws std::length_error at more than query.most_pairs contacts.
  void find(const Frame& frame, const Query& query, const RestingContacts& resting, Workers& workers);

  const BodyBroadPhase& near() const { return near_; }

  /// Copies all groups, one after another.
  void concatenate(Workers& workers, std::vector<Contact>& pairs);

  /// Adds what the last search did and what it could leave out.
  void count(Result& result) const;
  /// Where bodies overlap, and the leaves of the cuts there.
  std::vector<DebugGeometry::Box> boxes() const;

  void forget() { references_.forget(); }

 private:
  struct alignas(64) Thread {
    OverlapTree tree;
    FacingScratch facing;
    CullingReference::Scratch self;
    Words words;
    Picked whole;                // of one body
    std::vector<Contact> pairs;  // of its groups, in order
    std::size_t counted = 0;     // of the pairs, in found_
    std::vector<Contact> group, sorted;
    std::vector<Index> vertex_count;
    std::uint64_t self_contacts = 0, pair_tests = 0, parted = 0, unfolded = 0, kept = 0;
  };

  void begin(const Frame& frame, const Query& query, Workers& workers);
  void begin(Thread& own) const;
  /// Bodies are dealt by their pairs, each thread's one after another.
  void find_part(int thread, int threads, const RestingContacts& resting);
  void find_group(Thread& own, Index a);
  void keep_group(Thread& own, Index a, std::span<const Contact> group);
  void find_between(Thread& own, Index a, Index b);
  void find_self(Thread& own, Index body);
  void tidy_self(Thread& own, Index body);
  void order(Thread& own, Index a, bool runs_ordered);
  void count_pairs(Thread& own);
  Run run(Index body) const;

  const Frame* frame_ = nullptr;
  Query query_{};
  float reach_ = 0, tolerance2_ = 0;
  std::vector<Bound> bounds_;  // of every body
  std::vector<Index> live_;
  BodyBroadPhase near_;
  SelfCollisionCulling references_;
  std::vector<Thread> threads_;
  std::atomic<std::size_t> found_ = 0;
};

}  // namespace collide::exact
