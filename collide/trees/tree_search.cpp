#include "collide/trees/tree_search.h"

namespace collide::trees {

void search_tree(std::span<const Node> nodes, bool self, float cutoff, ContactSearch& search, Workers& workers) {
  if (nodes.empty()) return;
  const auto apart = [&](NodePair pair) {
    const Node& a = nodes[pair.a];
    return pair.a == pair.b ? a.whole_body && !self : !near(a.box, nodes[pair.b].box, cutoff);
  };
  std::vector<NodePair> pairs(1, {0, 0});
  const NodePairs node_pairs{nodes};
  node_pairs.deal(pairs, search.parts(), apart);
  workers.share(search.parts(), pairs.size(), [&](int thread, std::size_t k) {
    node_pairs.for_each_below(pairs[k], apart, [&](NodePair pair) {
      const Node &a = nodes[pair.a], &b = nodes[pair.b];
      if (pair.a == pair.b) {
        search.test(thread, a.slots(), a.slots());
      } else {
        search.test(thread, a.slots(), b.slots(), b.box);
      }
    });
  });
}

}  // namespace collide::trees
