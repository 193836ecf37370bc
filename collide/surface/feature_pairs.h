#pragma once
// Pairs of features by the dozen: where they are closest to each other, in the widest instructions of the processor
// (chosen at run time). The same answers as closest_features.h, to the bit.

#include <array>

#include "collide/surface/closest_features.h"

namespace collide::surface {

/// Columns of at most `most` pairs. Vertex and face: the vertex, then the face's corners; edges: the ends of the one,
/// then those of the other.
class FeaturePairs {
 public:
  static constexpr Index most = 64;

  void clear() { size_ = 0; }
  Index size() const { return size_; }
  bool full() const { return size_ == most; }
  /// tag: whatever says later which pair it was.
  void add(const std::array<glm::vec3, 4>& corners, Index tag) {
    for (std::size_t k = 0; k < 4; ++k)
      for (int axis = 0; axis < 3; ++axis) corner_[k][static_cast<std::size_t>(axis)][size_] = corners[k][axis];
    tag_[size_++] = tag;
  }

  void meet_vertices_and_faces();
  void meet_edges();

  Index tag(Index i) const { return tag_[i]; }
  glm::vec3 corner(std::size_t k, Index i) const { return {corner_[k][0][i], corner_[k][1][i], corner_[k][2][i]}; }
  float distance2(Index i) const { return distance2_[i]; }  // m^2
  bool inner(Index i) const { return inner_[i] != 0; }
  Closest closest_vertex_face(Index i) const {
    return {{1, 1 - first_[i] - second_[i], first_[i], second_[i]}, apart(i), inner(i)};
  }
  Closest closest_edges(Index i) const {
    return {{1 - first_[i], first_[i], 1 - second_[i], second_[i]}, apart(i), inner(i)};
  }

  // For the loops over the columns, which may run beyond size().
  Index columns() const { return (size_ + 15) / 16 * 16; }
  using Column = std::array<float, most>;
  std::array<std::array<Column, 3>, 4> corner_{};
  std::array<Column, 3> apart_{};
  Column first_{}, second_{}, distance2_{};
  Column inner_{};  // 0 or 1; of a vertex and a sliver, which has no inside, `sliver` until it has been looked at alone
  static constexpr float sliver = 2;

 private:
  glm::vec3 apart(Index i) const { return {apart_[0][i], apart_[1][i], apart_[2][i]}; }

  std::array<Index, most> tag_;
  Index size_ = 0;
};

}  // namespace collide::surface
