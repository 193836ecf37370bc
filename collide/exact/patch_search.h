#pragma once
// The contacts inside large bodies, and between two of them. All threads share the pairs of patches of one body.

#include "collide/core/vertex_run.h"
#include "collide/exact/patch_kernels.h"
#include "collide/trees/body_trees.h"

namespace collide::exact {

/// Goes down the trees of the bodies with pairs of nodes. A pair of nodes is left out if all its vertices are farther
/// apart than the tolerance now, and one of one body also if all are closer than that at rest. Nodes of a few patches
/// are not gone down further: their patches are tested in the vector loops.
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

  std::size_t patches() const { return node_of_patch_.size(); }
  /// Returns the boxes of the patches, for drawing.
  std::vector<DebugGeometry::Box> boxes() const;
  void forget() { trees_.forget(); }

 private:
  /// What is known of a node beside its box.
  struct About {
    Aabb rest;      // of its vertices at rest; everything where that is not known
    Range patches;  // of its vertices
    Index body;
  };
  void take_rest(const Frame& frame);
  void number_patches();
  void list_joined(const Frame& frame);
  bool apart(trees::NodePair pair) const;
  trees::NodePairs node_pairs() const { return {trees_.nodes(), most_patches * trees::BodyTrees::patch_size}; }

  static constexpr Index most_patches = max_lanes;  // of a node that is not gone down further

  float tolerance2_ = 0;
  std::vector<Index> which_;
  trees::BodyTrees trees_;
  std::vector<About> about_;          // by node
  std::vector<Index> node_of_patch_;  // ascending slots
  Patches patches_;
  std::vector<trees::NodePair> pairs_;
};

}  // namespace collide::exact
