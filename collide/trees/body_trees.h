#pragma once
// A tree for each body, made once and refitted: its leaves are patches of neighbouring vertices. Bodies of one mesh are
// cut alike. Memory: 24 bytes a vertex, and 40 bytes a node.

#include <unordered_map>

#include "collide/trees/tree_search.h"

namespace collide::trees {

class BodyTrees {
 public:
  /// Takes the positions of a frame. Makes the trees of the bodies `which`, unless they are those of the last frame,
  /// and refits all boxes. A mesh is cut by the positions of its first body in the frame that it first appears in, and
  /// cut anew once the patches of a body have spread to twice their share of it. Returns true if the slots and nodes
  /// are not those of the last frame.
  bool update(const Frame& frame, std::span<const Index> which, Workers& workers);
  /// Drops the cuts, so that the next frame makes them anew.
  void forget();

  const Points& points() const { return points_; }  // patch by patch
  /// Returns all nodes. Those in front of the bodies' are for a tree over all bodies: see upper().
  std::span<const Node> nodes() const { return nodes_; }
  /// Returns the nodes of the body which[k], the root first, children behind their parents.
  std::span<const Node> nodes_of(std::size_t k) const {
    return std::span(nodes_).subspan(first_node_[k], first_node_[k + 1] - first_node_[k]);
  }
  /// Returns the place among nodes() of the root of the body which[k].
  Index root(std::size_t k) const { return first_node_[k]; }
  /// Returns the room for a binary tree over the bodies; a leaf of it is a copy of a body's root.
  std::span<Node> upper() { return std::span(nodes_).first(first_node_.empty() ? 0 : first_node_.front()); }

 private:
  /// The tree of a mesh, with boxes of no meaning. Slots and nodes count from 0.
  struct Pattern {
    std::shared_ptr<const Shape> shape;  // kept alive, so that no other shape can take its address
    std::vector<Index> vertex;           // of each slot
    std::vector<Node> nodes;
    float spread = 0;  // see spread_of(), of the body that it was cut by
    Index cut_by = 0;  // that body
    bool used = false;

    void cut(const Frame& frame, Index body, std::vector<Item>& items);
    void cut(std::span<Item> items, Index node, Index first_slot);
  };
  using Patterns = std::unordered_map<const Shape*, Pattern>;
  void find_patterns(const Frame& frame, std::span<const Index> which, Patterns& patterns, Workers& workers);
  void lay_out(const Frame& frame, std::span<const Index> which, Workers& workers);
  void refit(const Frame& frame, Workers& workers);
  void refit_leaf(const Frame& frame, Node& leaf);
  float spread_of(std::size_t k) const;
  bool drop_spread_patterns();

  Patterns patterns_;
  std::vector<Pattern*> pattern_;         // of each of the bodies
  std::vector<std::vector<Item>> items_;  // by thread: of a mesh that is being cut
  Bodies bodies_;                         // of the last layout
  std::vector<Index> which_;              // the same
  std::vector<Index> first_node_;         // of each body, and the end of the last one's
  std::vector<float> spread_;             // of each body, see spread_of()
  std::vector<Node> nodes_;
  Points points_;
};

}  // namespace collide::trees
