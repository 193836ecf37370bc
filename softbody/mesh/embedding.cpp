#include "softbody/mesh/embedding.h"

#include <cassert>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace softbody {
namespace {

/// Returns the right-handed orthonormal axes of a normal and a tangent, of any lengths; zero if they have none.
glm::mat3 orthonormal(const glm::vec3& normal, const glm::vec3& tangent) {
  const glm::vec3 side = glm::cross(normal, tangent);
  const float n2 = glm::dot(normal, normal), s2 = glm::dot(side, side);
  if (!(n2 > 0 && s2 > 0)) return glm::mat3(0.0f);
  const glm::vec3 n = normal / std::sqrt(n2), s = side / std::sqrt(s2);
  return {glm::cross(s, n), s, n};
}

/// Writes the normal at each vertex, of any length.
void find_normals(const std::vector<Triangle>& triangles, const ConstPoints& at, std::vector<glm::vec3>& sum) {
  sum.assign(at.x.size(), glm::vec3(0.0f));
  for (const auto& [a, b, c] : triangles) {
    const glm::vec3 area = glm::cross(at[b] - at[a], at[c] - at[a]);
    sum[a] += area, sum[b] += area, sum[c] += area;
  }
}

}  // namespace

Embedding::Embedding(const Mesh& coarse, std::vector<Hold> holds)
    : holds_(std::move(holds)), triangles_(coarse.triangles), tangent_(coarse.vertices.size(), 0) {
  Points rest;
  rest.add(coarse.vertices);
  const ConstPoints at = rest;
  std::vector<glm::vec3> normal;
  find_normals(triangles_, at, normal);
  // The neighbour that stands out least from the plane of the tangents, relative to its distance.
  std::vector<float> steepest(tangent_.size(), INFINITY);
  for (const Edge& edge : coarse.edges)
    for (const auto& [from, to] : {std::pair(edge[0], edge[1]), std::pair(edge[1], edge[0])}) {
      const glm::vec3 way = at[to] - at[from];
      const float rise = std::abs(glm::dot(normal[from], way)) / glm::length(way);
      if (rise < steepest[from]) steepest[from] = rise, tangent_[from] = to;
    }
  for (std::size_t i = 0; i < tangent_.size(); ++i)
    rest_inverse_.push_back(glm::transpose(orthonormal(normal[i], at[tangent_[i]] - at[i])));
}

void Embedding::place(const ConstPoints& coarse, std::span<float> x, std::span<float> y, std::span<float> z,
                      Scratch& scratch) const {
  assert(coarse.x.size() == tangent_.size() && x.size() == holds_.size());
  auto& [normal, axes] = scratch;
  find_normals(triangles_, coarse, normal);
  axes.resize(normal.size());
  for (std::size_t i = 0; i < axes.size(); ++i)
    axes[i] = {coarse[i], orthonormal(normal[i], coarse[tangent_[i]] - coarse[i]) * rest_inverse_[i]};
  for (std::size_t i = 0; i < holds_.size(); ++i) {
    const Hold& hold = holds_[i];
    const Axes &a = axes[hold.corner[0]], &b = axes[hold.corner[1]], &c = axes[hold.corner[2]];
    const glm::vec3 p = hold.weight.x * (a.origin + a.turn * hold.offset) +
                        hold.weight.y * (b.origin + b.turn * hold.offset) +
                        hold.weight.z * (c.origin + c.turn * hold.offset);
    x[i] = p.x, y[i] = p.y, z[i] = p.z;
  }
}

}  // namespace softbody
