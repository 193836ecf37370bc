#pragma once
// Finds the closest points of many pairs of features at once. Vectorised; the processor's instruction set is chosen at
// run time. The results are those of closest_features.h, to the bit.

#include <array>
#include <cassert>

#include "collide/surface/closest_features.h"

namespace collide::surface {

enum class PairKind { vertex_face, edge_edge };

/// Returns how many of the four corners of a pair are those of its first feature.
constexpr std::size_t corners_of_first(PairKind kind) { return kind == PairKind::vertex_face ? 1 : 2; }

/// Returns the corners of a vertex of surface `a` and a face of surface `b`, or of an edge of each.
template <PairKind kind>
std::array<Index, 4> corners_of(const Surface& a, Index feature_a, const Surface& b, Index feature_b) {
  if constexpr (kind == PairKind::vertex_face) {
    const Triangle& face = b.triangles()[feature_b];
    return {feature_a, face[0], face[1], face[2]};
  } else {
    const Edge &one = a.edges()[feature_a], &other = b.edges()[feature_b];
    return {one[0], one[1], other[0], other[1]};
  }
}

/// At most `capacity` pairs of features, stored in columns. The corners of a vertex and a face: the vertex, then the
/// corners of the face. Those of two edges: the ends of the first, then the ends of the second.
class FeatureBatch {
 public:
  static constexpr Index capacity = 64;

  void clear() { size_ = 0; }
  Index size() const { return size_; }
  bool full() const { return size_ == capacity; }
  /// Adds a pair. tag: any number by which the caller identifies it. Precondition: not full().
  void add(const std::array<glm::vec3, 4>& corners, Index tag) {
    assert(!full());
    for (std::size_t k = 0; k < 4; ++k)
      for (int axis = 0; axis < 3; ++axis) corner_[k][static_cast<std::size_t>(axis)][size_] = corners[k][axis];
    tag_[size_++] = tag;
  }

  /// Find the closest points of all pairs, as vertices and faces or as edges.
  void find_closest_vertex_faces();
  void find_closest_edges();
  template <PairKind kind>
  void find_closest() {
    if constexpr (kind == PairKind::vertex_face)
      find_closest_vertex_faces();
    else
      find_closest_edges();
  }

  Index tag(Index i) const { return tag_[i]; }
  glm::vec3 corner(std::size_t k, Index i) const { return {corner_[k][0][i], corner_[k][1][i], corner_[k][2][i]}; }
  float distance2(Index i) const { return distance2_[i]; }  // m^2
  bool inner(Index i) const { return inner_[i] != 0; }
  Closest closest_vertex_face(Index i) const {
    return {{1, 1 - first_[i] - second_[i], first_[i], second_[i]}, separation(i), inner(i)};
  }
  Closest closest_edges(Index i) const {
    return {{1 - first_[i], first_[i], 1 - second_[i], second_[i]}, separation(i), inner(i)};
  }

  // For the vectorised loops, which run up to padded_size().
  Index padded_size() const { return (size_ + 15) / 16 * 16; }
  using Column = std::array<float, capacity>;
  std::array<std::array<Column, 3>, 4> corner_{};
  std::array<Column, 3> separation_{};
  Column first_{}, second_{};  // parameters s and t of two edges; the weights of b and c of a face
  Column distance2_{};
  Column inner_{};  // 0 or 1; or `sliver` for a degenerate face that must be treated by closest_vertex_face()
  static constexpr float sliver = 2;

 private:
  glm::vec3 separation(Index i) const { return {separation_[0][i], separation_[1][i], separation_[2][i]}; }

  std::array<Index, capacity> tag_;
  Index size_ = 0;
};

}  // namespace collide::surface
