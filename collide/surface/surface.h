#pragma once
// Triangle meshes as surfaces, for everything that asks about faces and not only about vertices.

#include "collide/core/frame.h"

namespace collide::surface {

using Triangle = std::array<Index, 3>;  // local vertices, counter-clockwise seen from outside
using Edge = std::array<Index, 2>;      // local vertices, the smaller one first

/// The triangles of a mesh. Shared by all bodies that are copies of one mesh. Immutable.
class Surface {
 public:
  /// Throws std::invalid_argument if a triangle names a missing vertex, or one vertex twice.
  Surface(Index vertex_count, std::vector<Triangle> triangles);

  Index vertex_count() const { return vertex_count_; }
  std::size_t feature_count() const { return vertex_count_ + edges_.size() + triangles_.size(); }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// The sides of all triangles, each once; ascending.
  const std::vector<Edge>& edges() const { return edges_; }
  /// The triangles at each edge; on a border the same one twice, and two of them where more meet.
  const std::vector<std::array<Index, 2>>& edge_triangles() const { return edge_triangles_; }
  /// The triangles around a vertex; ascending.
  std::span<const Index> around(Index vertex) const {
    return std::span(around_).subspan(first_[vertex], first_[vertex + std::size_t{1}] - first_[vertex]);
  }
  /// True if the mesh has triangles and every side is run through as often one way as the other: only then is each
  /// point of space, however the mesh is deformed, clearly inside or outside.
  bool closed() const { return closed_; }

 private:
  Index vertex_count_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
  std::vector<std::array<Index, 2>> edge_triangles_;
  std::vector<Index> first_, around_;  // vertex_count + 1 offsets into around_
  bool closed_;
};

/// The surface of each body of a frame; null: the body has none, and only its vertices take part.
using Surfaces = std::vector<std::shared_ptr<const Surface>>;

}  // namespace collide::surface
