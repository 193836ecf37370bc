#pragma once
// Triangle meshes as surfaces, for contact and for the oracle, which need faces and not only vertices.

#include <cassert>
#include <mutex>

#include "collide/core/vertex_run.h"

namespace collide::surface {

using Triangle = std::array<Index, 3>;  // local vertices, counter-clockwise seen from outside
using Edge = std::array<Index, 2>;      // local vertices, the smaller one first

/// The features of one kind in the order of their patches: see trees/patch_cut.h.
struct FeaturePatches {
  std::vector<Index> feature;                 // by place
  std::vector<std::array<Index, 3>> corners;  // by place: its vertices, of which some may be the same

  Index size() const { return static_cast<Index>(feature.size()); }
};
/// The pairs of a feature of one list and a feature of another, or of one list, that can never meet: those that share a
/// vertex and, in one list, those of which the second one has the earlier place.
class JoinedPairs {
 public:
  struct Patch {
    Index other;                         // patch of the second list
    std::array<std::uint64_t, 4> pairs;  // bit 16 i + j: feature i of the patch, feature j of the other one
  };
  JoinedPairs() = default;
  /// Lists the pairs of two lists of a surface with so many vertices, or within one. Throws std::length_error if there
  /// are too many, as of a vertex of 12,000 edges.
  JoinedPairs(const FeaturePatches& ones, const FeaturePatches& twos, Index vertices);

  std::vector<Patch> patches;
  std::vector<Index> first{0};  // by patch of the first list, and one more: of its run in `patches`, others ascending
};

struct SurfacePatches {
  FeaturePatches vertices, faces, edges;
};
struct SurfaceJoints {
  JoinedPairs vertex_faces, edge_edges;
};

/// The triangles of a mesh. All bodies that are copies of one mesh share it. Immutable.
class Surface {
 public:
  /// Throws std::invalid_argument if a triangle names a vertex that does not exist, or one vertex twice.
  Surface(Index vertex_count, std::vector<Triangle> triangles);

  Index vertex_count() const { return vertex_count_; }
  std::size_t feature_count() const { return vertex_count_ + edges_.size() + triangles_.size(); }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Returns the sides of all triangles, each once; ascending.
  const std::vector<Edge>& edges() const { return edges_; }
  /// Returns two triangles for each edge: its only triangle twice on a border, the first and the last one if there are
  /// more than two.
  const std::vector<std::array<Index, 2>>& edge_triangles() const { return edge_triangles_; }
  /// Returns the triangles that have the vertex as a corner; ascending.
  std::span<const Index> triangles_at(Index vertex) const {
    assert(vertex < vertex_count_);
    return std::span(triangles_at_).subspan(first_[vertex], first_[vertex + std::size_t{1}] - first_[vertex]);
  }
  /// Returns true if the mesh has triangles, and they run along every side equally often in both directions. Only then
  /// is each point of space clearly inside or outside, however the mesh is deformed.
  bool closed() const { return closed_; }
  /// Returns the patches, which are cut where the vertices are when this is called first. Several threads may call it.
  const SurfacePatches& patches(const VertexRun& at) const;
  /// Returns the joined pairs of these patches, for the same callers. Throws as JoinedPairs does.
  const SurfaceJoints& joints(const VertexRun& at) const;

 private:
  Index vertex_count_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
  std::vector<std::array<Index, 2>> edge_triangles_;
  std::vector<Index> first_, triangles_at_;  // vertex_count + 1 offsets into triangles_at_
  bool closed_;
  struct Cut {
    std::once_flag patched, joined;
    SurfacePatches patches;
    SurfaceJoints joints;
  };
  std::shared_ptr<Cut> cut_ = std::make_shared<Cut>();
};

/// The surface of each body of a frame. Null if a body has none: then only its vertices take part.
using Surfaces = std::vector<std::shared_ptr<const Surface>>;

}  // namespace collide::surface
