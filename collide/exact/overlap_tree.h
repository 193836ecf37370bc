#pragma once
// The tree over the area where two bodies, or a body and itself, can touch: what the paper's §5 names as future work.
// The area is cut at midpoints as in §2.1, level by level, but only where enough vertices of both sides are left.

#include "collide/core/aabb.h"
#include "collide/exact/pair_kernels.h"

namespace collide::exact {

/// One thread's search for the contacts of picked vertices. Keeps its memory.
class OverlapTree {
 public:
  /// A cut reads both sides several times, vertex by vertex; that pays only where it saves more tests than these.
  static constexpr std::uint64_t leaf_tests = 16384;

  /// levels: of cuts, at most. Clears the counts and the leaves.
  void begin(int levels, float reach, float tolerance2, std::size_t most_contacts);

  /// Appends the contacts between two sets of vertices, or within one; each pair once. If there was more than one leaf
  /// they are in no order. body: whose leaves they are. Throws std::length_error once `contacts` has more than
  /// most_contacts.
  void between(const Picked& a, const Picked& b, Index body, std::vector<Contact>& contacts);
  void within(const Picked& set, Index body, std::vector<Contact>& contacts, const Exclusion& excluded = {});

  std::uint64_t pair_tests() const { return pair_tests_; }
  std::uint64_t leaves() const { return leaves_.size(); }
  /// The boxes of the leaves that come from cuts, and of the uncut areas within bodies.
  const std::vector<DebugGeometry::Box>& leaves_list() const { return leaves_; }

 private:
  struct Level {
    Picked near_a, near_b, low_a, low_b, up_a, up_b;  // of between()
    Picked low, up, low_edge, up_edge;                // of within()
  };
  void cut_between(const Picked& a, const Picked& b, int depth);
  void cut_within(const Picked& set, int depth);

  int levels_ = 0;
  float reach_ = 0, tolerance2_ = 0;
  std::size_t most_contacts_ = 0;
  Index body_ = 0;
  Exclusion excluded_;
  std::vector<Contact>* contacts_ = nullptr;
  std::vector<Level> level_;
  Words words_;
  std::vector<DebugGeometry::Box> leaves_;
  std::uint64_t pair_tests_ = 0;
};

}  // namespace collide::exact
