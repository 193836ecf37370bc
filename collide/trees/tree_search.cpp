#include "collide/trees/tree_search.h"

namespace collide::trees {

void TreeSearch::run(std::span<const Node> nodes, bool self, float cutoff, ContactSearch& search, Workers& workers) {
  if (nodes.empty()) return;
  const auto apart = [&](NodePair pair) {
    const Node& a = nodes[pair.a];
    return pair.a == pair.b ? a.whole_body && !self : !near(a.box, nodes[pair.b].box, cutoff);
  };
  pairs_.assign(1, {0, 0});
  const NodePairs node_pairs{nodes};
  const int parts = search.parts();
  node_pairs.deal(pairs_, parts, apart);
  workers.run(parts, [&](int part) {
    const auto test = [&](NodePair pair) {
      const Node &a = nodes[pair.a], &b = nodes[pair.b];
      if (pair.a == pair.b) {
        search.test(part, a.slots(), a.slots());
      } else {
        search.test(part, a.slots(), b.slots(), b.box);
      }
    };
    const auto step = static_cast<std::size_t>(parts);
    for (auto k = static_cast<std::size_t>(part); k < pairs_.size(); k += step) {
      node_pairs.for_each_below(pairs_[k], apart, test);
    }
  });
}

}  // namespace collide::trees
