#pragma once
// Repeated measurements of one duration.

#include <algorithm>
#include <numeric>
#include <vector>

namespace app {

/// In milliseconds; min() and median() need at least one.
struct Timings {
  std::vector<double> ms;

  double total() const { return std::accumulate(ms.begin(), ms.end(), 0.0); }
  double min() const { return *std::min_element(ms.begin(), ms.end()); }
  double median() const {
    std::vector<double> sorted = ms;
    std::sort(sorted.begin(), sorted.end());
    return (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]) / 2;
  }
};

}  // namespace app
