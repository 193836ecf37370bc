#pragma once
// What a detector is given: positions as three spans of world floats, and which body owns which of them.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace collide {

using Index = std::uint32_t;

/// Which vertices of a mesh are joined by an edge. Shared by all bodies that are copies of one mesh. Immutable.
class Topology {
 public:
  /// edges: pairs of local vertex indices, in any order, duplicates allowed; self loops are ignored.
  /// Throws std::invalid_argument if an edge names a missing vertex.
  Topology(Index vertex_count, std::span<const std::array<Index, 2>> edges);

  Index vertex_count() const { return static_cast<Index>(first_.size() - 1); }
  bool joined(Index i, Index j) const;
  /// The vertices joined to one by an edge; ascending.
  std::span<const Index> neighbours(Index i) const {
    return std::span(neighbour_).subspan(first_[i], first_[i + std::size_t{1}] - first_[i]);
  }
  bool operator==(const Topology&) const = default;

 private:
  std::vector<Index> first_;      // vertex_count + 1 offsets into neighbour_
  std::vector<Index> neighbour_;  // the mesh neighbours of each vertex, ascending
};

/// A mesh and, where it is known, its shape at rest. It decides which vertex pairs of one body can never be contacts:
/// those joined by a mesh edge, and those closer than the tolerance at rest. Immutable.
class Shape {
 public:
  /// rest: rest positions in metres, one a vertex, or empty: then no pair is left out for its rest distance.
  /// Throws std::invalid_argument if the number of rest positions is another.
  explicit Shape(std::shared_ptr<const Topology> topology, std::vector<glm::vec3> rest = {});
  /// With a topology of its own.
  Shape(Index vertex_count, std::span<const std::array<Index, 2>> edges, std::vector<glm::vec3> rest = {});

  Index vertex_count() const { return topology_->vertex_count(); }
  const Topology& topology() const { return *topology_; }
  const std::shared_ptr<const Topology>& shared_topology() const { return topology_; }
  const std::vector<glm::vec3>& rest() const { return rest_; }

  /// True if the local vertices i and j may never be a contact of one body.
  /// tolerance2 = tolerance * tolerance in float; the rest distance is tested with collide::squared_distance.
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
  void add(std::shared_ptr<const Shape> mesh) {
    first.push_back(first.back() + mesh->vertex_count());
    shape.push_back(std::move(mesh));
  }
};

/// One frame: world positions in metres, bodies->vertex_count() of each coordinate. Owns nothing.
struct Frame {
  std::span<const float> x, y, z;
  const Bodies* bodies = nullptr;
};

/// The one distance expression of the project, so that equal sets are equal to the bit. A contact is
/// squared_distance < tolerance * tolerance, all in float and (by a compiler flag) never fused.
inline float squared_distance(float ax, float ay, float az, float bx, float by, float bz) {
  const float dx = ax - bx, dy = ay - by, dz = az - bz;
  return dx * dx + dy * dy + dz * dz;
}

}  // namespace collide
