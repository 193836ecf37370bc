#pragma once
// The input of a detector: positions, as three spans of floats, and the bodies that own them.

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace collide {

using Index = std::uint32_t;

/// The edges of a mesh, and its triangles where they are known. All bodies that are copies of one mesh share it.
/// Immutable.
class Topology {
 public:
  /// edges: pairs of local vertex indices, in any order; duplicates are allowed, self loops are ignored.
  /// triangles: of local vertex indices; only kept. Throws std::invalid_argument if an edge names a vertex that does
  /// not exist.
  Topology(Index vertex_count, std::span<const std::array<Index, 2>> edges,
           std::vector<std::array<Index, 3>> triangles = {});

  Index vertex_count() const { return static_cast<Index>(first_.size() - 1); }
  bool joined(Index i, Index j) const;
  /// Returns the vertices that an edge joins to vertex i; ascending.
  std::span<const Index> neighbours(Index i) const {
    return std::span(neighbour_).subspan(first_[i], first_[i + std::size_t{1}] - first_[i]);
  }
  const std::vector<std::array<Index, 3>>& triangles() const { return triangles_; }
  bool operator==(const Topology&) const = default;

 private:
  std::vector<Index> first_;      // vertex_count + 1 offsets into neighbour_
  std::vector<Index> neighbour_;  // the mesh neighbours of each vertex, ascending
  std::vector<std::array<Index, 3>> triangles_;
};

/// A mesh and, where it is known, its rest shape. It decides which vertex pairs of one body can never be contacts:
/// those that a mesh edge joins, and those that are closer than the tolerance in the rest shape. Immutable.
class Shape {
 public:
  /// rest: rest positions in metres, one for each vertex; or empty if the rest shape is not known.
  /// Throws std::invalid_argument if their number is neither.
  explicit Shape(std::shared_ptr<const Topology> topology, std::vector<glm::vec3> rest = {});
  /// Makes a topology of its own.
  Shape(Index vertex_count, std::span<const std::array<Index, 2>> edges, std::vector<glm::vec3> rest = {});

  Index vertex_count() const { return topology_->vertex_count(); }
  const Topology& topology() const { return *topology_; }
  const std::shared_ptr<const Topology>& shared_topology() const { return topology_; }
  const std::vector<glm::vec3>& rest() const { return rest_; }

  /// Returns true if the local vertices i and j can never be a contact of one body. tolerance2: tolerance * tolerance
  /// in float (m^2); the rest distance is compared with it by squared_distance().
  bool excludes(Index i, Index j, float tolerance2) const;

 private:
  std::shared_ptr<const Topology> topology_;
  std::vector<glm::vec3> rest_;
};

/// The bodies of a frame: body b owns the vertices first[b] .. first[b + 1] - 1 and has the mesh *shape[b].
struct Bodies {
  std::vector<Index> first{0};  // count() + 1 offsets, ascending
  std::vector<std::shared_ptr<const Shape>> shape;

  Index count() const { return static_cast<Index>(shape.size()); }
  Index vertex_count() const { return first.back(); }
  Index size(Index body) const { return first[body + 1] - first[body]; }
  /// Returns the body that owns a vertex. Precondition: vertex < vertex_count().
  Index body_of(Index vertex) const {
    assert(vertex < vertex_count());
    return static_cast<Index>(std::upper_bound(first.begin(), first.end(), vertex) - first.begin()) - 1;
  }
  void add(std::shared_ptr<const Shape> mesh) {
    first.push_back(first.back() + mesh->vertex_count());
    shape.push_back(std::move(mesh));
  }
};

/// One frame: world positions in metres, bodies->vertex_count() of each coordinate. It owns nothing.
struct Frame {
  std::span<const float> x, y, z;
  const Bodies* bodies = nullptr;
};

/// Returns the position (m) of a vertex.
inline glm::vec3 position(const Frame& frame, Index vertex) {
  return {frame.x[vertex], frame.y[vertex], frame.z[vertex]};
}

/// Returns true if the frame has bodies and a position for each of their vertices: the precondition of every detection.
inline bool is_complete(const Frame& frame) {
  if (!frame.bodies) return false;
  const std::size_t count = frame.bodies->vertex_count();
  return frame.x.size() == count && frame.y.size() == count && frame.z.size() == count;
}

/// Returns the squared distance of two vertices (m^2). Every method uses this expression, so that all exact methods
/// find the same contacts to the bit: a contact is squared_distance() < tolerance * tolerance, in float and (by a
/// compiler flag) without fused multiply-add.
inline float squared_distance(float ax, float ay, float az, float bx, float by, float bz) {
  const float dx = ax - bx, dy = ay - by, dz = az - bz;
  return dx * dx + dy * dy + dz * dz;
}

}  // namespace collide
