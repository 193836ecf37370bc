#include "collide/trees/body_trees.h"

#include <algorithm>
#include <numeric>

#include <glm/common.hpp>

namespace collide::trees {

namespace {

Aabb bounds_of(const Points& points, Range slots) {
  glm::vec3 lo(points.x[slots.begin], points.y[slots.begin], points.z[slots.begin]), hi = lo;
  for (Index slot = slots.begin + 1; slot < slots.end; ++slot) {
    const glm::vec3 p(points.x[slot], points.y[slot], points.z[slot]);
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  return {lo, hi};
}

}  // namespace

void BodyTrees::update(const Frame& frame, std::span<const Index> which, Workers& workers) {
  if (!std::ranges::equal(which, which_) || frame.bodies->first != bodies_.first ||
      frame.bodies->shape != bodies_.shape || patterns_.empty()) {
    lay_out(frame, which);
  }
  workers.run([&](int thread) {
    const Part part = part_of(which.size(), thread, workers.threads());
    for (std::size_t k = part.begin; k < part.end; ++k) refit(frame, k);
  });
}

void BodyTrees::forget() { patterns_.clear(); }

void BodyTrees::lay_out(const Frame& frame, std::span<const Index> which) {
  for (auto& [shape, pattern] : patterns_) pattern.used = false;
  bodies_ = *frame.bodies;
  which_.assign(which.begin(), which.end());
  first_node_.assign(1, static_cast<Index>(which.empty() ? 0 : 2 * which.size() - 1));
  nodes_.assign(first_node_.front(), {});
  points_.resize(bodies_.vertex_count());  // an upper bound
  Index slots = 0;
  for (const Index body : which) {
    const Pattern& pattern = pattern_of(frame, body);
    for (Node node : pattern.nodes) {
      node.first += node.is_leaf() ? slots : first_node_.back();
      nodes_.push_back(node);
    }
    first_node_.push_back(static_cast<Index>(nodes_.size()));
    for (const Index vertex : pattern.vertex) points_.set(slots++, frame, bodies_.first[body] + vertex, body);
  }
  points_.resize(slots);
  std::erase_if(patterns_, [](const auto& item) { return !item.second.used; });
}

const BodyTrees::Pattern& BodyTrees::pattern_of(const Frame& frame, Index body) {
  const std::shared_ptr<const Shape>& shape = frame.bodies->shape[body];
  Pattern& pattern = patterns_[shape.get()];
  pattern.used = true;
  if (pattern.nodes.empty()) {
    pattern.shape = shape;
    pattern.vertex.resize(shape->vertex_count());
    std::iota(pattern.vertex.begin(), pattern.vertex.end(), Index{0});
    pattern.nodes.emplace_back();
    cut(pattern, frame, frame.bodies->first[body], 0, {0, shape->vertex_count()});
    pattern.nodes.front().whole_body = true;
  }
  return pattern;
}

/// Cuts across the longest side, near the median, so that all patches but one are full.
void BodyTrees::cut(Pattern& pattern, const Frame& frame, Index first_vertex, Index node, Range slots) {
  if (slots.size() <= patch_size) {
    pattern.nodes[node] = {{}, slots.begin, 0, slots.size(), false};
    return;
  }
  const auto vertices = std::span(pattern.vertex).subspan(slots.begin, slots.size());
  std::span<const float> longest;
  float length = -1;
  for (const std::span<const float> axis : {frame.x, frame.y, frame.z}) {
    const std::span<const float> own = axis.subspan(first_vertex);
    const auto [lo, hi] = std::ranges::minmax(vertices, {}, [own](Index v) { return own[v]; });
    if (own[hi] - own[lo] > length) length = own[hi] - own[lo], longest = own;
  }
  const Index low = (slots.size() / 2 + patch_size - 1) / patch_size * patch_size;
  std::ranges::nth_element(vertices, vertices.begin() + low, {}, [longest](Index v) { return longest[v]; });
  const auto child = static_cast<Index>(pattern.nodes.size());
  pattern.nodes[node] = {{}, child, 2, slots.size(), false};
  pattern.nodes.resize(pattern.nodes.size() + 2);
  cut(pattern, frame, first_vertex, child, {slots.begin, slots.begin + low});
  cut(pattern, frame, first_vertex, child + 1, {slots.begin + low, slots.end});
}

/// From the leaves to the root.
void BodyTrees::refit(const Frame& frame, std::size_t k) {
  for (Index at = first_node_[k + 1]; at-- > first_node_[k];) {
    Node& node = nodes_[at];
    if (!node.is_leaf()) {
      const Aabb &one = nodes_[node.first].box, &other = nodes_[node.first + std::size_t{1}].box;
      node.box = {glm::min(one.lo, other.lo), glm::max(one.hi, other.hi)};
      continue;
    }
    const Range slots = node.slots();
    for (Index slot = slots.begin; slot < slots.end; ++slot) {
      points_.x[slot] = frame.x[points_.vertex[slot]];
      points_.y[slot] = frame.y[points_.vertex[slot]];
      points_.z[slot] = frame.z[points_.vertex[slot]];
    }
    node.box = bounds_of(points_, slots);
  }
}

}  // namespace collide::trees
