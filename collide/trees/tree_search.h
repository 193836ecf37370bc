#pragma once
// Trees of boxes over vertices, and how pairs of their nodes are gone down and shared by threads.

#include <algorithm>

#include "collide/core/aabb.h"
#include "collide/core/contact_search.h"
#include "collide/core/workers.h"

namespace collide::trees {

inline constexpr Index patch_size = 16;  // items, at most

/// A vertex on its way into the leaves of a tree.
struct Item {
  std::array<float, 3> at;  // m
  Index number;             // of the vertex, among those of the tree
};

inline Aabb bounds_of(std::span<const Item> items) {
  return box_around(0, items.size(),
                    [&](std::size_t k) { return glm::vec3(items[k].at[0], items[k].at[1], items[k].at[2]); });
}

/// Brings the items below the one that belongs to the place `middle` along the axis before it, and the others behind.
inline void part_at(std::span<Item> items, std::size_t middle, std::size_t axis) {
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(middle), items.end(),
                   [axis](const Item& a, const Item& b) { return a.at[axis] < b.at[axis]; });
}

struct Node {
  Aabb box;         // of its vertices
  Index first;      // its first child, or the first slot of a leaf
  Index children;   // how many nodes from `first` on; 0 for a leaf
  Index size;       // number of vertices
  bool whole_body;  // its vertices are those of one body

  bool is_leaf() const { return children == 0; }
  Range slots() const { return {first, first + size}; }  // of a leaf
};

struct NodePair {
  Index a, b;  // the same: the pairs within a node
};

/// Goes down a tree with pairs of nodes, down to nodes of at most `least` vertices, or to leaves.
struct NodePairs {
  std::span<const Node> nodes;
  Index least = 0;  // vertices

  /// Calls emit(pair) for the pairs one level below a pair, except those that are apart(pair). Returns false for a pair
  /// of nodes that it does not go below.
  template <class Apart, class Emit>
  bool go_down(NodePair pair, const Apart& apart, const Emit& emit) const {
    const Node &a = nodes[pair.a], &b = nodes[pair.b];
    const auto is_end = [&](const Node& node) { return node.is_leaf() || node.size <= least; };
    const auto emit_if_near = [&](Index one, Index other) {
      if (!apart(NodePair{one, other})) emit(NodePair{one, other});
    };
    if (is_end(a) && is_end(b)) return false;
    if (pair.a == pair.b) {
      for (Index i = a.first; i < a.first + a.children; ++i) {
        for (Index j = i; j < a.first + a.children; ++j) emit_if_near(i, j);
      }
    } else if (is_end(b) || (!is_end(a) && a.size >= b.size)) {
      for (Index i = a.first; i < a.first + a.children; ++i) emit_if_near(i, pair.b);
    } else {
      for (Index j = b.first; j < b.first + b.children; ++j) emit_if_near(pair.a, j);
    }
    return true;
  }

  /// Calls test(pair) for the last pairs below a pair, except those below a pair that is apart().
  template <class Apart, class Test>
  void for_each_below(NodePair pair, const Apart& apart, const Test& test) const {
    if (!go_down(pair, apart, [&](NodePair below) { for_each_below(below, apart, test); })) test(pair);
  }

  /// Replaces pairs by those below them, level by level, until there are enough to share the work among so many
  /// threads: one thread takes them as they are. Memory: 8 bytes for each of at most a few hundred pairs a thread.
  template <class Apart>
  void deal(std::vector<NodePair>& pairs, int threads, const Apart& apart) const {
    constexpr std::size_t pairs_a_thread = 64;
    const std::size_t enough = threads > 1 ? pairs_a_thread * static_cast<std::size_t>(threads) : 1;
    std::erase_if(pairs, apart);
    std::vector<NodePair> next;
    for (bool at_end = false; !at_end && pairs.size() < enough; pairs.swap(next)) {
      next.clear();
      at_end = true;
      for (const NodePair pair : pairs) {
        if (go_down(pair, apart, [&](NodePair below) { next.push_back(below); })) {
          at_end = false;
        } else {
          next.push_back(pair);
        }
      }
    }
  }
};

/// Finds all contacts among the vertices of a tree: goes down the tree with pairs of nodes whose boxes are near().
/// nodes: the root first, or none. self: also inside a whole body. cutoff: m. Call search.begin() before, and
/// search.finish() after.
void search_tree(std::span<const Node> nodes, bool self, float cutoff, ContactSearch& search, Workers& workers);

}  // namespace collide::trees
