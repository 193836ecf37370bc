#pragma once
// The time between pictures: measured, and limited where no monitor sets the pace.

#include <chrono>
#include <cmath>
#include <thread>

namespace app::window {

/// Seconds of a steady clock.
inline double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class PictureTimer {
 public:
  /// Begins a picture and returns the seconds since the last one. Times close to a multiple of 1/60 s are rounded to
  /// it: no monitor runs at exactly 60 Hz, and without rounding some pictures would show two steps and some none.
  double tick() {
    const double time = now(), elapsed = time - last_;
    last_ = time;
    const double periods = std::round(elapsed * 60);
    return periods >= 1 && std::abs(elapsed * 60 - periods) < 0.2 ? periods / 60 : elapsed;
  }
  /// Sleeps so that there are at most 125 pictures a second. Without a monitor to wait for, pictures would follow each
  /// other at once and load the machine for nothing.
  void limit_rate() const {
    constexpr double min_interval = 1.0 / 125;
    const double left = min_interval - (now() - last_);
    if (left > 0) std::this_thread::sleep_for(std::chrono::duration<double>(left));
  }

 private:
  double last_ = now();
};

}  // namespace app::window
