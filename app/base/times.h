#pragma once
// Processor time, and repeated measurements of one duration.

#include <time.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace app {

/// Returns the processor time of this thread (s).
inline double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// In milliseconds; least() and median() need at least one.
struct Times {
  std::vector<double> ms;

  double total() const { return std::accumulate(ms.begin(), ms.end(), 0.0); }
  double least() const { return *std::min_element(ms.begin(), ms.end()); }
  double median() const {
    std::vector<double> sorted = ms;
    std::sort(sorted.begin(), sorted.end());
    return (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]) / 2;
  }
};

}  // namespace app
