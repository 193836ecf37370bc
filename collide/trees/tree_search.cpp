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
  node_pairs.deal(pairs_, workers.threads(), apart);
  workers.run([&](int thread) {
    const auto test = [&](NodePair pair) {
      const Node &a = nodes[pair.a], &b = nodes[pair.b];
      if (pair.a == pair.b) {
        search.test(thread, a.slots(), a.slots());
      } else {
        search.test(thread, a.slots(), b.slots(), b.box);
      }
    };
    const auto step = static_cast<std::size_t>(workers.threads());
    for (auto k = static_cast<std::size_t>(thread); k < pairs_.size(); k += step) {
      node_pairs.for_each_below(pairs_[k], apart, test);
    }
  });
}

}  // namespace collide::trees
