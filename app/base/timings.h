#pragma once
// Measures durations.

#include <algorithm>
#include <cassert>
#include <chrono>
#include <numeric>
#include <vector>

namespace app {

/// Runs an action and returns its duration (ms).
template <class Action>
double time_ms(const Action& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Durations of one action, in milliseconds. min() and median() require at least one.
struct Timings {
  std::vector<double> ms;

  double total() const { return std::accumulate(ms.begin(), ms.end(), 0.0); }
  double min() const {
    assert(!ms.empty());
    return *std::min_element(ms.begin(), ms.end());
  }
  double median() const {
    assert(!ms.empty());
    std::vector<double> sorted = ms;
    std::sort(sorted.begin(), sorted.end());
    return (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]) / 2;
  }
};

}  // namespace app
