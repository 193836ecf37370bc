#pragma once
// Trees of boxes over vertices, and the contacts among the vertices of one tree.

#include "collide/core/contact_search.h"
#include "collide/core/workers.h"

namespace collide::trees {

struct Node {
  Aabb box;         // of its vertices
  Index first;      // its first child, or the first slot of a leaf
  Index children;   // how many nodes from `first` on; 0 for a leaf
  Index size;       // number of vertices
  bool whole_body;  // its vertices are those of one body

  bool is_leaf() const { return children == 0; }
  Range slots() const { return {first, first + size}; }  // of a leaf
};

/// Finds all contacts among the vertices of a tree: goes down the tree with pairs of nodes whose boxes are near().
/// Memory: 8 bytes for each of at most a few hundred pairs of nodes a thread.
class TreeSearch {
 public:
  /// nodes: the root first, or none. self: also inside a whole body. cutoff: m. Call search.begin() before, and
  /// search.finish() after.
  void run(std::span<const Node> nodes, bool self, float cutoff, ContactSearch& search, Workers& workers);

 private:
  struct Pair {
    Index a, b;  // the same: the pairs within a node
  };
  template <class Emit>
  bool go_down(Pair pair, const Emit& emit) const;
  void deal(std::size_t enough);
  void search_below(int thread, Pair pair);
  void test_leaves(int thread, Pair pair);

  std::span<const Node> nodes_;
  bool self_ = true;
  float cutoff_ = 0;
  ContactSearch* search_ = nullptr;
  std::vector<Pair> pairs_, next_;
};

}  // namespace collide::trees
