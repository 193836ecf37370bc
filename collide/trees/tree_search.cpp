#include "collide/trees/tree_search.h"

namespace collide::trees {

void TreeSearch::run(std::span<const Node> nodes, bool self, float cutoff, ContactSearch& search, Workers& workers) {
  nodes_ = nodes;
  self_ = self;
  cutoff_ = cutoff;
  search_ = &search;
  constexpr std::size_t pairs_a_thread = 64;
  if (nodes.empty()) return;
  deal(workers.threads() > 1 ? pairs_a_thread * static_cast<std::size_t>(workers.threads()) : 1);
  workers.run([&](int thread) {
    const auto step = static_cast<std::size_t>(workers.threads());
    for (auto k = static_cast<std::size_t>(thread); k < pairs_.size(); k += step) search_below(thread, pairs_[k]);
  });
}

/// Calls emit(pair) for the near pairs one level below a pair. Returns false for a pair of leaves.
template <class Emit>
bool TreeSearch::go_down(Pair pair, const Emit& emit) const {
  const Node &a = nodes_[pair.a], &b = nodes_[pair.b];
  const auto emit_if_near = [&](Index one, Index other) {
    if (near(nodes_[one].box, nodes_[other].box, cutoff_)) emit(Pair{one, other});
  };
  if (pair.a == pair.b) {
    if (a.whole_body && !self_) return true;
    for (Index i = a.first; i < a.first + a.children; ++i) {
      emit(Pair{i, i});
      for (Index j = i + 1; j < a.first + a.children; ++j) emit_if_near(i, j);
    }
    return !a.is_leaf();
  }
  if (a.is_leaf() && b.is_leaf()) return false;
  if (b.is_leaf() || (!a.is_leaf() && a.size >= b.size)) {
    for (Index i = a.first; i < a.first + a.children; ++i) emit_if_near(i, pair.b);
  } else {
    for (Index j = b.first; j < b.first + b.children; ++j) emit_if_near(pair.a, j);
  }
  return true;
}

/// Lists pairs of nodes with all the work below them, level by level until there are enough.
void TreeSearch::deal(std::size_t enough) {
  pairs_.assign(1, {0, 0});
  for (bool all_leaves = false; !all_leaves && pairs_.size() < enough;) {
    next_.clear();
    all_leaves = true;
    for (const Pair pair : pairs_) {
      if (go_down(pair, [&](Pair below) { next_.push_back(below); })) {
        all_leaves = false;
      } else {
        next_.push_back(pair);
      }
    }
    pairs_.swap(next_);
  }
}

void TreeSearch::search_below(int thread, Pair pair) {
  if (!go_down(pair, [&](Pair below) { search_below(thread, below); })) test_leaves(thread, pair);
}

void TreeSearch::test_leaves(int thread, Pair pair) {
  const Node &a = nodes_[pair.a], &b = nodes_[pair.b];
  if (pair.a == pair.b) {
    search_->test(thread, a.slots(), a.slots());
  } else {
    search_->test(thread, a.slots(), b.slots(), b.box);
  }
}

}  // namespace collide::trees
