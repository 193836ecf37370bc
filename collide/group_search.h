#pragma once
// The work of a frame, body by body: the group of a body is every pair of vertices closer than a distance whose first
// vertex is the body's. All pairs of the frame, in their order, are the groups one after another.

#include <atomic>

#include "collide/near_bodies.h"
#include "collide/overlap_tree.h"
#include "collide/self_proof.h"

namespace collide {

class GroupSearch {
 public:
  struct Query {
    float distance;   // m: pairs with squared_distance < distance * distance are found,
    float tolerance;  // but none that Shape::excludes() at this tolerance
    bool self;        // also pairs within bodies
    int levels;       // of cuts of the area where two bodies, or one and itself, overlap
    std::size_t most_pairs;
  };

  /// Finds where the bodies are, and names those that are not finite: they are in no group.
  void bound(const Frame& frame, Workers& workers, std::vector<Index>& non_finite_bodies);

  /// Finds the bodies near each other, then all groups; or those that `wanted` says, given the near ones. After bound()
  /// of the same frame. Throws std::length_error at more than query.most_pairs pairs, and where one body alone has so
  /// many before those that Shape::excludes() are taken out.
  void find(const Frame& frame, const Query& query, Workers& workers);
  void find_near(float distance, Workers& workers);
  template <class Wanted>
  void find_groups(const Frame& frame, const Query& query, Workers& workers, const Wanted& wanted);

  const std::vector<Index>& live() const { return live_; }  // bodies with vertices, all of them finite; ascending
  const NearBodies& near() const { return near_; }

  /// The group of a live body that was wanted, and the bodies that its pairs lead to, itself left out; ascending.
  std::span<const Contact> group(Index body) const;
  std::span<const Index> partners(Index body) const;

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
    SelfReference::Scratch self;
    Words words;
    Picked whole;                // of one body
    std::vector<Contact> pairs;  // of its groups, in order
    std::vector<Index> partners;
    std::size_t counted = 0;  // of the pairs, in found_
    std::vector<Contact> group, sorted;
    std::vector<Index> vertex_count;
    std::uint64_t self_contacts = 0, pair_tests = 0, parted = 0, unfolded = 0;
  };
  struct Slice {
    Index thread;
    std::size_t begin, end, first_partner, last_partner;
  };

  void begin(const Frame& frame, const Query& query, Workers& workers);
  void begin(Thread& own) const;
  /// Bodies are dealt by their pairs, each thread's one after another.
  template <class Wanted>
  void find_part(int thread, int threads, const Wanted& wanted);
  void find_group(int thread, Index a);
  void find_between(Thread& own, Index a, Index b);
  void find_self(Thread& own, Index body);
  void tidy_self(Thread& own, Index body);
  void order(Thread& own, Index a, bool runs_ordered);
  void count_pairs(Thread& own);
  Run run(Index body) const;

  const Frame* frame_ = nullptr;
  Query query_{};
  float reach_ = 0, distance2_ = 0, tolerance2_ = 0;
  std::vector<Bound> bounds_;  // of every body
  std::vector<Index> live_;
  NearBodies near_;
  SelfReferences references_;
  std::vector<Thread> threads_;
  std::vector<Slice> slices_;  // of every body
  std::atomic<std::size_t> found_ = 0;
};

template <class Wanted>
void GroupSearch::find_groups(const Frame& frame, const Query& query, Workers& workers, const Wanted& wanted) {
  begin(frame, query, workers);
  workers.run([&](int thread) { find_part(thread, workers.threads(), wanted); });
  for (Thread& thread : threads_) count_pairs(thread);  // the rest, so that no more pass on many threads than on one
}

template <class Wanted>
void GroupSearch::find_part(int thread, int threads, const Wanted& wanted) {
  begin(threads_[static_cast<std::size_t>(thread)]);
  const Part part = part_of(near_.pairs() + live_.size(), thread, threads);
  for (std::size_t k = 0; k < live_.size(); ++k) {
    const std::size_t place = near_.pairs_before(live_[k]) + k;
    if (place >= part.begin && place < part.end && wanted(live_[k])) find_group(thread, live_[k]);
  }
}

}  // namespace collide
