#pragma once
// A shape cut into patches once, for all bodies that have it.

#include "collide/exact/patch_kernels.h"

namespace collide::exact {

class PatchedShape {
 public:
  /// Cuts by the rest shape, or by the body (m) where a position at rest is missing or not finite.
  PatchedShape(const std::shared_ptr<const Shape>& shape, const VertexRun& body);
  /// Cuts anew, by a body.
  void cut(const VertexRun& body);
  /// Lists what is known of the pairs of patches, unless it is of these settings already. cutoff: m.
  void list_pairs(float tolerance2, float cutoff);

  /// Returns null once nobody has the shape any more.
  std::shared_ptr<const Shape> shape() const { return shape_.lock(); }
  const KnownPairs& known() const { return known_; }
  /// Returns the local vertex of each place: see Patches.
  const std::vector<Index>& vertices() const { return vertex_; }
  Index groups() const { return static_cast<Index>(vertex_.size() / Patches::group_size); }
  Index patches() const { return static_cast<Index>((slot_.size() + Patches::size - 1) / Patches::size); }
  /// Returns whether it was cut by the rest shape.
  bool is_of_rest() const { return of_rest_; }

  double spread = 0;  // m: how large the patches were together when they were cut, or, if larger, right after

 private:
  void list_pairs(const Topology& topology, Index patch, float tolerance2, float cutoff, GroupHits& near);
  void leave_out_joined(const Topology& topology, Index patch);

  static constexpr std::size_t most_masks = 64;  // of a patch, on average: others are near at times, and then found

  std::weak_ptr<const Shape> shape_;
  bool of_rest_ = false;
  Patches reference_;                       // boxes of what it was cut by
  std::array<std::vector<float>, 3> rest_;  // m, by place; NaN where it is not known
  std::vector<Index> vertex_, slot_;        // of each place; the place of each vertex
  float tolerance2_ = 0;                    // of known_; 0: of none
  KnownPairs known_;
  std::vector<Index> listed_;  // by patch: which of known_.other names it for a patch; 0 if none does
};

/// Returns how large the patches are together (m): the sum of the sides of their boxes.
double spread_of(const BoxColumns& boxes, Range patches);

}  // namespace collide::exact
