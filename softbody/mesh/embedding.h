#pragma once
// A fine mesh that rides on a coarse one: where the vertices of the coarse mesh are decides where those of the fine one
// are.

#include <array>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>

#include "softbody/mesh/mesh.h"
#include "softbody/mesh/points.h"

namespace softbody {

/// Each fine vertex is held by the corners of one coarse triangle. With its closest point on the triangle, of
/// barycentric coordinates w_i, and its offset d from there, both at rest, it stands at
///
///   p = sum of w_i (x_i + R_i d).
///
/// R_i is the rotation of the surface around the corner i: it takes the normal at rest to the present one, and a
/// tangent along. So a rigid motion of the coarse mesh moves the fine one rigidly, and the fine surface has no crease
/// where its vertices change from one triangle to the next.
class Embedding {
  /// Where a coarse vertex is, and how the surface around it has turned.
  struct Axes {
    glm::vec3 origin;
    glm::mat3 turn;
  };

 public:
  /// How the coarse mesh holds a fine vertex.
  struct Hold {
    std::array<Index, 3> corner;  // vertices of the coarse mesh
    glm::vec3 weight;             // their sum is 1
    glm::vec3 offset;             // m, at rest
  };

  /// What place() works with. It keeps its memory, so use it again.
  class Scratch {
    friend Embedding;
    std::vector<glm::vec3> normal_;  // at each coarse vertex
    std::vector<Axes> axes_;
  };

  Embedding() = default;
  /// coarse: the mesh at rest; each of its vertices has a face.
  Embedding(const Mesh& coarse, std::vector<Hold> holds);

  std::size_t size() const { return holds_.size(); }
  const Hold& operator[](std::size_t vertex) const { return holds_[vertex]; }
  /// Writes where the fine vertices are. Around a coarse vertex whose faces have no area, offsets are left out.
  void place(const ConstPoints& coarse, std::span<float> x, std::span<float> y, std::span<float> z,
             Scratch& scratch) const;

 private:
  std::vector<Hold> holds_;
  std::vector<Triangle> triangles_;      // of the coarse mesh
  std::vector<Index> tangent_;           // of each coarse vertex: the neighbour to which its tangent points
  std::vector<glm::mat3> rest_inverse_;  // of the axes of each coarse vertex at rest
};

}  // namespace softbody
