#pragma once
// A tree over all vertices, built anew from the top: each node is cut as a method wants it. Memory: 60 bytes a vertex,
// and 40 bytes a node.

#include "collide/trees/tree_search.h"

namespace collide::trees {

/// The sizes of the parts of a node.
struct Parts {
  static constexpr Index max_count = 8;
  std::array<Index, max_count> size{};
  Index count = 0;
};

/// Copies the items part by part to `to`, which has room for them. Returns the parts: none of them is empty, and there
/// are two at least, or else none, for a node that is to be a leaf. box: of the items.
using Cut = Parts (*)(std::span<const Item> items, const Aabb& box, Item* to);

class PointTree {
 public:
  /// Builds the tree of the vertices of the bodies `which`. Nodes of at most `leaf_size` vertices are leaves.
  void build(const Frame& frame, std::span<const Index> which, Cut cut, Index leaf_size, Workers& workers);

  /// Returns the nodes; the first one is the root. There is none without vertices.
  std::span<const Node> nodes() const { return nodes_; }
  const Points& points() const { return points_; }  // leaf by leaf

 private:
  /// A node that may have to be cut. Its items are in one of the two buffers.
  struct Pending {
    Index node, first, size;
    std::size_t buffer;
  };
  void list_items(const Frame& frame, std::span<const Index> which, Workers& workers);
  template <class Emit>
  void make(std::vector<Node>& nodes, const Pending& pending, const Emit& emit);
  void make_below(std::vector<Node>& nodes, const Pending& pending);
  void fill_leaf(const Pending& pending);

  Cut cut_ = nullptr;
  Index leaf_size_ = 0;
  std::array<std::vector<Item>, 2> items_;
  std::vector<Index> vertex_, body_;  // by number
  std::vector<Node> nodes_;
  std::vector<Pending> pending_, next_;
  std::vector<std::vector<Node>> below_;  // of each pending node: itself and what lies below it
  Points points_;
};

}  // namespace collide::trees
