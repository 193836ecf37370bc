#pragma once
// The contacts inside large bodies, and between two of them. All threads share the pairs of patches of one body.

#include "collide/exact/patch_kernels.h"
#include "collide/trees/body_trees.h"

namespace collide::exact {

/// Goes down the trees of the bodies with pairs of nodes. A pair of nodes is left out if all its vertices are farther
/// apart than the tolerance now, and one of one body also if all are closer than that at rest.
class PatchSearch {
 public:
  /// Starts a frame with the positions of some bodies; ascending.
  void begin(const Frame& frame, std::span<const Index> which, float tolerance2, Workers& workers);
  /// Adds the pairs inside one of these bodies, or between two of them.
  void add(Index a, Index b);
  /// Shares the pairs among threads: as many tasks as the caller should deal.
  std::size_t deal(int threads);

  struct Found {
    std::uint64_t pair_tests = 0, self_contacts = 0;
  };
  /// Appends the contacts of a task; in no order. Throws std::length_error if `contacts` grows beyond max_contacts.
  Found find(std::size_t task, std::size_t max_contacts, std::vector<Contact>& contacts) const;

  /// Returns the boxes of the patches, for drawing.
  std::vector<DebugGeometry::Box> boxes() const;
  void forget() { trees_.forget(); }

 private:
  void take_rest(const Frame& frame);
  void take_rest_boxes();
  void list_joined(const Frame& frame);
  bool apart(trees::NodePair pair) const;

  float tolerance2_ = 0;
  std::vector<Index> which_;
  trees::BodyTrees trees_;
  PatchPoints points_;
  std::vector<PatchBoxes> boxes_;  // of each node
  std::vector<Index> body_;        // of each node
  std::vector<trees::NodePair> pairs_;
};

}  // namespace collide::exact
