#include "collide/trees/point_tree.h"

#include <algorithm>

namespace collide::trees {

void PointTree::build(const Frame& frame, std::span<const Index> which, Cut cut, Index leaf_size, Workers& workers) {
  cut_ = cut;
  leaf_size_ = leaf_size;
  list_items(frame, which, workers);
  nodes_.clear();
  pending_.clear();
  if (points_.size() == 0) return;
  nodes_.emplace_back();
  pending_.push_back({0, 0, points_.size(), 0});
  constexpr double build_ns = 70;  // of work, of a vertex
  const int threads = workers.threads_for(build_ns * static_cast<double>(points_.size()));
  // The upper nodes on this thread, until there are enough to deal; with one thread that is the root.
  const std::size_t enough = threads > 1 ? 4 * static_cast<std::size_t>(threads) : 1;
  while (!pending_.empty() && pending_.size() < enough) {
    next_.clear();
    for (const Pending& pending : pending_)
      make(nodes_, pending, [&](const Pending& below) { next_.push_back(below); });
    pending_.swap(next_);
  }
  below_.resize(std::max(below_.size(), pending_.size()));
  workers.share(threads, pending_.size(), [&](int, std::size_t k) {
    below_[k].assign(1, {});
    make_below(below_[k], {0, pending_[k].first, pending_[k].size, pending_[k].buffer});
  });
  for (std::size_t k = 0; k < pending_.size(); ++k) {
    const auto moved_by = static_cast<Index>(nodes_.size()) - 1;  // all but the first
    for (Node& node : below_[k]) node.first += node.is_leaf() ? 0 : moved_by;
    nodes_[pending_[k].node] = below_[k].front();
    nodes_.insert(nodes_.end(), below_[k].begin() + 1, below_[k].end());
  }
}

void PointTree::list_items(const Frame& frame, std::span<const Index> which, Workers& workers) {
  const VertexList vertices(*frame.bodies, which);
  points_.resize(vertices.size());
  for (auto* by_number : {&vertex_, &body_}) by_number->resize(vertices.size());
  for (auto& buffer : items_) buffer.resize(vertices.size());
  constexpr double item_ns = 5;  // of work
  const int parts = workers.threads_for(item_ns * static_cast<double>(vertices.size()));
  workers.run(parts, [&](int part) {
    vertices.for_each(part_of(vertices.size(), part, parts), [&](Index number, Index vertex, Index body) {
      items_[0][number] = {{frame.x[vertex], frame.y[vertex], frame.z[vertex]}, number};
      vertex_[number] = vertex;
      body_[number] = body;
    });
  });
}

/// Makes a node: a leaf, or one with children, for each of which it calls emit(pending).
template <class Emit>
void PointTree::make(std::vector<Node>& nodes, const Pending& pending, const Emit& emit) {
  const std::span<const Item> items = std::span(items_[pending.buffer]).subspan(pending.first, pending.size);
  const Aabb box = bounds_of(items);
  Parts parts;
  if (pending.size > leaf_size_) parts = cut_(items, box, items_[1 - pending.buffer].data() + pending.first);
  const auto first_child = static_cast<Index>(nodes.size());
  nodes[pending.node] = {box, parts.count == 0 ? pending.first : first_child, parts.count, pending.size, false};
  if (parts.count == 0) return fill_leaf(pending);
  nodes.resize(nodes.size() + parts.count);
  Index first = pending.first;
  for (Index child = 0; child < parts.count; ++child) {
    emit(Pending{first_child + child, first, parts.size[child], 1 - pending.buffer});
    first += parts.size[child];
  }
}

void PointTree::make_below(std::vector<Node>& nodes, const Pending& pending) {
  make(nodes, pending, [&](const Pending& below) { make_below(nodes, below); });
}

void PointTree::fill_leaf(const Pending& pending) {
  for (Index slot = pending.first; slot < pending.first + pending.size; ++slot) {
    const Item& item = items_[pending.buffer][slot];
    points_.x[slot] = item.at[0];
    points_.y[slot] = item.at[1];
    points_.z[slot] = item.at[2];
    points_.vertex[slot] = vertex_[item.number];
    points_.body[slot] = body_[item.number];
  }
}

}  // namespace collide::trees
