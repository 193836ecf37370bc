#pragma once
// Measures durations.

#include <time.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <numeric>
#include <vector>

namespace app {

/// Returns what a clock shows (s).
inline double clock_seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
/// Returns the processor time (s) of this thread, or of all threads together.
inline double thread_seconds() { return clock_seconds(CLOCK_THREAD_CPUTIME_ID); }
inline double process_seconds() { return clock_seconds(CLOCK_PROCESS_CPUTIME_ID); }

/// What was timed, summed over all of it.
struct TimedParts {
  double wall = 0, processor = 0;  // s
  TimedParts& operator+=(const TimedParts& other) {
    wall += other.wall;
    processor += other.processor;
    return *this;
  }
};

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
