#include "engine/run_loop.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace engine {

void run_loop(std::function<bool()> turn) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds min_interval(8);
  for (Clock::time_point next = Clock::now(); turn();) {
    std::this_thread::sleep_until(next += min_interval);
    next = std::max(next, Clock::now());
  }
}

}  // namespace engine
