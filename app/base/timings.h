#pragma once
// Measures durations.

#include <time.h>

#include <algorithm>
#include <array>
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

/// Returns the time (ms) that has passed.
inline double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Runs an action and returns its duration (ms).
template <class Action>
double time_ms(const Action& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return ms_since(start);
}

/// Returns the least time (ms) that the clock sees: 0.1 ms and more in a browser.
inline double clock_tick_ms() {
  static const double tick = [] {
    std::array<double, 3> ticks{};  // while one is measured, the thread may have to wait
    for (double& ms : ticks)
      for (const auto start = std::chrono::steady_clock::now(); ms <= 0;) ms = ms_since(start);
    return *std::ranges::min_element(ticks);
  }();
  return tick;
}

/// Runs an action after `prepare` and returns its duration (ms). If that is few ticks of the clock, it returns the mean
/// of as many of both as the clock needs.
template <class Prepare, class Action>
double mean_ms(const Prepare& prepare, const Action& action) {
  const double enough = 20 * clock_tick_ms();
  prepare();
  if (const double ms = time_ms(action); ms >= enough) return ms;
  int runs = 0;
  const auto start = std::chrono::steady_clock::now();
  for (; ms_since(start) < enough; ++runs) prepare(), action();
  return ms_since(start) / runs;
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
