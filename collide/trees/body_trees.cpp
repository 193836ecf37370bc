#include "collide/trees/body_trees.h"

#include <algorithm>
#include <utility>

namespace collide::trees {

bool BodyTrees::update(const Frame& frame, std::span<const Index> which, Workers& workers) {
  bool fresh = !std::ranges::equal(which, which_) || frame.bodies->first != bodies_.first ||
               frame.bodies->shape != bodies_.shape || patterns_.empty();
  if (fresh) lay_out(frame, which, workers);
  refit(frame, workers);
  if (drop_spread_patterns()) {
    fresh = true;
    lay_out(frame, which, workers);
    refit(frame, workers);
  }
  for (std::size_t k = 0; k < which_.size(); ++k) {
    if (pattern_[k]->spread == 0 && pattern_[k]->cut_by == which_[k]) pattern_[k]->spread = spread_[k];
  }
  return fresh;
}

void BodyTrees::forget() { patterns_.clear(); }

void BodyTrees::lay_out(const Frame& frame, std::span<const Index> which, Workers& workers) {
  Patterns patterns = std::exchange(patterns_, {});  // none, should this fail half-way: then all is laid out anew
  find_patterns(frame, which, patterns, workers);
  bodies_ = *frame.bodies;
  which_.assign(which.begin(), which.end());
  first_node_.assign(1, static_cast<Index>(which.empty() ? 0 : 2 * which.size() - 1));
  nodes_.assign(first_node_.front(), {});
  points_.resize(bodies_.vertex_count());  // an upper bound
  Index slots = 0;
  for (std::size_t k = 0; k < which.size(); ++k) {
    const Index body = which[k];
    for (Node node : pattern_[k]->nodes) {
      node.first += node.is_leaf() ? slots : first_node_.back();
      nodes_.push_back(node);
    }
    first_node_.push_back(static_cast<Index>(nodes_.size()));
    for (const Index vertex : pattern_[k]->vertex) points_.set(slots++, frame, bodies_.first[body] + vertex, body);
  }
  points_.resize(slots);
  patterns_ = std::move(patterns);
}

/// Finds the pattern of each body. Cuts the meshes that are new, and drops those that no body has any more.
void BodyTrees::find_patterns(const Frame& frame, std::span<const Index> which, Patterns& patterns, Workers& workers) {
  for (auto& [shape, pattern] : patterns) pattern.used = false;
  pattern_.clear();
  std::vector<std::pair<Pattern*, Index>> fresh;  // and the body that each is cut by
  for (const Index body : which) {
    const std::shared_ptr<const Shape>& shape = frame.bodies->shape[body];
    Pattern& pattern = patterns[shape.get()];
    if (!pattern.shape) {
      pattern.shape = shape;
      pattern.cut_by = body;
    }
    if (!pattern.used && pattern.nodes.empty()) fresh.emplace_back(&pattern, pattern.cut_by);
    pattern.used = true;
    pattern_.push_back(&pattern);
  }
  constexpr double cut_ns = 100;  // of work, of a vertex
  double vertices = 0;
  for (const auto& [pattern, body] : fresh) vertices += static_cast<double>(frame.bodies->size(body));
  const int parts = workers.threads_for(cut_ns * vertices);
  items_.resize(static_cast<std::size_t>(parts));
  workers.share(parts, fresh.size(), [&](int thread, std::size_t k) {
    fresh[k].first->cut(frame, fresh[k].second, items_[static_cast<std::size_t>(thread)]);
  });
  std::erase_if(patterns, [](const auto& item) { return !item.second.used; });
}

void BodyTrees::Pattern::cut(const Frame& frame, Index body, std::vector<Item>& items) {
  const Index first = frame.bodies->first[body], size = frame.bodies->size(body);
  items.clear();
  for (Index v = 0; v < size; ++v) items.push_back({{frame.x[first + v], frame.y[first + v], frame.z[first + v]}, v});
  nodes.assign(1, {});
  cut(items, 0, 0);
  nodes.front().whole_body = true;
  for (const Item& item : items) vertex.push_back(item.number);
}

/// Cuts across the longest side, near the median, so that all patches but one are full.
void BodyTrees::Pattern::cut(std::span<Item> items, Index node, Index first_slot) {
  const auto size = static_cast<Index>(items.size());
  if (size <= patch_size) {
    nodes[node] = {{}, first_slot, 0, size, false};
    return;
  }
  const Aabb box = bounds_of(items);
  const Index low = (size / 2 + patch_size - 1) / patch_size * patch_size;
  part_at(items, low, static_cast<std::size_t>(longest_axis(box.hi * 0.5f - box.lo * 0.5f)));
  const auto child = static_cast<Index>(nodes.size());
  nodes[node] = {{}, child, 2, size, false};
  nodes.resize(nodes.size() + 2);
  cut(items.first(low), child, first_slot);
  cut(items.subspan(low), child + 1, first_slot + low);
}

/// The leaves, in parts of about the same size, then the others of each body from below.
void BodyTrees::refit(const Frame& frame, Workers& workers) {
  const std::size_t first = first_node_.front();
  spread_.resize(which_.size());
  constexpr double leaf_ns = 3, upper_ns = 1;  // of work, of a vertex
  const auto vertices = static_cast<double>(points_.size());
  const int leaf_parts = workers.threads_for(leaf_ns * vertices);
  workers.run(leaf_parts, [&](int number) {
    const Part part = part_of(nodes_.size() - first, number, leaf_parts);
    for (std::size_t at = first + part.begin; at < first + part.end; ++at) {
      if (nodes_[at].is_leaf()) refit_leaf(frame, nodes_[at]);
    }
  });
  const int parts = workers.threads_for(upper_ns * vertices);
  workers.share(parts, which_.size(), [&](int, std::size_t k) {
    for (Index at = first_node_[k + 1]; at-- > first_node_[k];) {
      Node& node = nodes_[at];
      if (node.is_leaf()) continue;
      node.box = joint(nodes_[node.first].box, nodes_[node.first + std::size_t{1}].box);
    }
    spread_[k] = spread_of(k);
  });
}

void BodyTrees::refit_leaf(const Frame& frame, Node& leaf) {
  const Range slots = leaf.slots();
  for (Index slot = slots.begin; slot < slots.end; ++slot) {
    points_.x[slot] = frame.x[points_.vertex[slot]];
    points_.y[slot] = frame.y[points_.vertex[slot]];
    points_.z[slot] = frame.z[points_.vertex[slot]];
  }
  leaf.box = box_around(slots.begin, slots.end,
                        [&](std::size_t slot) { return glm::vec3(points_.x[slot], points_.y[slot], points_.z[slot]); });
}

/// Returns how large the patches of a body are, all together, beside the body; never 0.
float BodyTrees::spread_of(std::size_t k) const {
  const auto sides = [](const Aabb& box) {
    const glm::dvec3 side = glm::dvec3(box.hi) - glm::dvec3(box.lo);
    return side.x + side.y + side.z;
  };
  double sum = 0;
  for (const Node& node : nodes_of(k)) sum += node.is_leaf() ? sides(node.box) : 0;
  const double whole = sides(nodes_of(k).front().box);
  return whole > 0 && sum > 0 ? static_cast<float>(sum / whole) : 1;
}

/// Empties the patterns whose patches have spread in some body, for a new cut by that body.
bool BodyTrees::drop_spread_patterns() {
  bool dropped = false;
  for (std::size_t k = 0; k < which_.size(); ++k) {
    Pattern& pattern = *pattern_[k];
    if (pattern.spread == 0 || !(spread_[k] > 2 * pattern.spread)) continue;
    pattern = {pattern.shape, {}, {}, 0, which_[k], false};
    dropped = true;
  }
  return dropped;
}

}  // namespace collide::trees
