#include "collide/core/frame.h"

#include <stdexcept>
#include <utility>

namespace collide {

Topology::Topology(Index vertex_count, std::span<const std::array<Index, 2>> edges,
                   std::vector<std::array<Index, 3>> triangles)
    : first_(vertex_count + std::size_t{1}, 0), triangles_(std::move(triangles)) {
  std::vector<std::array<Index, 2>> directed;
  directed.reserve(2 * edges.size());
  for (const auto& [i, j] : edges) {
    if (i >= vertex_count || j >= vertex_count) throw std::invalid_argument("Topology: an edge names a missing vertex");
    if (i == j) continue;
    directed.push_back({i, j});
    directed.push_back({j, i});
  }
  std::sort(directed.begin(), directed.end());
  directed.erase(std::unique(directed.begin(), directed.end()), directed.end());

  neighbour_.reserve(directed.size());
  for (const auto& [i, j] : directed) {
    ++first_[i + std::size_t{1}];
    neighbour_.push_back(j);
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

bool Topology::joined(Index i, Index j) const {
  const std::span<const Index> ascending = neighbours(i);
  return std::binary_search(ascending.begin(), ascending.end(), j);
}

Shape::Shape(std::shared_ptr<const Topology> topology, std::vector<glm::vec3> rest)
    : topology_(std::move(topology)), rest_(std::move(rest)) {
  if (!rest_.empty() && rest_.size() != vertex_count()) {
    throw std::invalid_argument("Shape: one rest position a vertex, or none");
  }
}

Shape::Shape(Index vertex_count, std::span<const std::array<Index, 2>> edges, std::vector<glm::vec3> rest)
    : Shape(std::make_shared<Topology>(vertex_count, edges), std::move(rest)) {}

bool Shape::excludes(Index i, Index j, float tolerance2) const {
  if (!rest_.empty()) {
    const glm::vec3 &a = rest_[i], &b = rest_[j];
    if (squared_distance(a.x, a.y, a.z, b.x, b.y, b.z) < tolerance2) return true;
  }
  return topology_->joined(i, j);
}

}  // namespace collide
