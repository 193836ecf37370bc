#pragma once
// A tree over the area where two bodies can touch: the future work of the paper's §5. The area is cut at midpoints as
// in §2.1, level by level, but only where enough vertices of both sides are left.

#include "collide/core/aabb.h"
#include "collide/exact/pair_kernels.h"

namespace collide::exact {

/// Finds the contacts between sets of vertices, for one thread. Keeps its memory from call to call.
class OverlapTree {
 public:
  /// Up to this many pairs are tested without a further cut: a cut reads both sides several times.
  static constexpr std::uint64_t leaf_tests = 16384;
  /// More pairs than this are cut further, however deep: else large bodies would cost the square of their vertices.
  static constexpr std::uint64_t max_leaf_tests = 32 * leaf_tests;

  /// Starts a frame: clears the counters and the leaves. levels: depth of the cuts of all but large leaves. cutoff: m.
  void begin(int levels, float cutoff, float tolerance2, std::size_t max_contacts);

  /// Appends each contact between two sets of vertices once. The contacts are sorted only if there was a single leaf.
  /// body: the owner of the leaves, for drawing. Throws std::length_error if `contacts` grows beyond max_contacts.
  void between(const VertexSet& a, const VertexSet& b, Index body, std::vector<Contact>& contacts);

  std::uint64_t pair_tests() const { return pair_tests_; }
  std::uint64_t leaves() const { return leaves_.size(); }
  /// Returns the boxes of the leaves that come from cuts.
  const std::vector<DebugGeometry::Box>& leaf_boxes() const { return leaves_; }

 private:
  static constexpr int max_depth = 48;  // of points that are next to each other in one corner of a large box
  struct Level {
    VertexSet near_a, near_b, low_a, low_b, up_a, up_b;
  };
  /// Returns true if so many pairs are tested without a further cut.
  bool is_leaf(std::uint64_t tests, int depth) const {
    return tests <= leaf_tests || depth == max_depth || (depth >= levels_ && tests <= max_leaf_tests);
  }
  void cut_between(const VertexSet& a, const VertexSet& b, int depth);

  int levels_ = 0;
  float cutoff_ = 0, tolerance2_ = 0;
  std::size_t max_contacts_ = 0;
  Index body_ = 0;
  std::vector<Contact>* contacts_ = nullptr;
  std::vector<Level> level_ = std::vector<Level>(max_depth);
  Words words_;
  std::vector<DebugGeometry::Box> leaves_;
  std::uint64_t pair_tests_ = 0;
};

}  // namespace collide::exact
