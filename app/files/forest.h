#pragma once
// What is connected: sets of vertices that are joined step by step.

#include <algorithm>
#include <numeric>
#include <vector>

#include "collide/core/frame.h"

namespace app::files {

/// A tree for each set; its root is the smallest vertex.
class Forest {
 public:
  explicit Forest(std::size_t vertices) : parent_(vertices) { std::iota(parent_.begin(), parent_.end(), 0u); }
  collide::Index root(collide::Index v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void join(collide::Index a, collide::Index b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<collide::Index> parent_;
};

}  // namespace app::files
