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

/// Mesh shared by all bodies of one kind. It decides which vertex pairs of one body can never be contacts:
/// those joined by a mesh edge, and those closer than the tolerance at rest. Immutable after construction.
class Shape {
 public:
  /// edges: pairs of local vertex indices, in any order, duplicates allowed; self loops are ignored.
  /// rest: rest positions in metres, one a vertex, or empty: then no pair is left out for its rest distance.
  /// Throws std::invalid_argument if an edge names a missing vertex or the number of rest positions is another.
  Shape(Index vertex_count, std::span<const std::array<Index, 2>> edges, std::vector<glm::vec3> rest = {});

  Index vertex_count() const { return static_cast<Index>(first_.size() - 1); }
  const std::vector<glm::vec3>& rest() const { return rest_; }

  /// True if the local vertices i and j may never be a contact of one body.
  /// tolerance2 = tolerance * tolerance in float; the rest distance is tested with collide::squared_distance.
  bool excludes(Index i, Index j, float tolerance2) const;

 private:
  std::vector<Index> first_;      // vertex_count + 1 offsets into neighbour_
  std::vector<Index> neighbour_;  // the mesh neighbours of each vertex, ascending
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
