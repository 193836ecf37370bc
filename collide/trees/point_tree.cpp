#include "collide/trees/point_tree.h"

#include <algorithm>

namespace collide::trees {

namespace {

Aabb bounds_of(std::span<const Item> items) {
  std::array<float, 3> lo = items.front().at, hi = lo;
  for (const Item& item : items) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], item.at[axis]);
      hi[axis] = std::max(hi[axis], item.at[axis]);
    }
  }
  return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
}

}  // namespace

void PointTree::build(const Frame& frame, std::span<const Index> which, Cut cut, Index leaf_size, Workers& workers) {
  cut_ = cut;
  leaf_size_ = leaf_size;
  list_items(frame, which, workers);
  nodes_.clear();
  pending_.clear();
  if (points_.size() == 0) return;
  nodes_.emplace_back();
  pending_.push_back({0, 0, points_.size(), 0});
  // The upper nodes on this thread, until there are enough to deal; with one thread that is the root.
  const std::size_t enough = workers.threads() > 1 ? 4 * static_cast<std::size_t>(workers.threads()) : 1;
  while (!pending_.empty() && pending_.size() < enough) {
    next_.clear();
    for (const Pending& pending : pending_)
      make(nodes_, pending, [&](const Pending& below) { next_.push_back(below); });
    pending_.swap(next_);
  }
  below_.resize(std::max(below_.size(), pending_.size()));
  workers.run([&](int thread) {
    const auto step = static_cast<std::size_t>(workers.threads());
    for (auto k = static_cast<std::size_t>(thread); k < pending_.size(); k += step) {
      below_[k].assign(1, {});
      make_below(below_[k], {0, pending_[k].first, pending_[k].size, pending_[k].buffer});
    }
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
  workers.run([&](int thread) {
    const Part part = part_of(vertices.size(), thread, workers.threads());
    vertices.for_each(part, [&](Index number, Index vertex, Index body) {
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
