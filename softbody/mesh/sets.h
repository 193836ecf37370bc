#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "softbody/mesh/mesh.h"

namespace softbody {

/// Disjoint sets of numbers, each named by its least number.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(Index a, Index b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace softbody
