#pragma once
// The time between pictures.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace app {

/// s, from some moment on.
inline double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// s that it took.
template <class Task>
double timed(Task task) {
  const double before = now();
  task();
  return now() - before;
}

/// Time between drawn frames. A monitor of 60 Hz never ticks at exactly the world's 1/60 s, and without rounding some
/// frames would show two steps and some none.
class Pacer {
 public:
  double tick() {
    const double time = now(), elapsed = time - last_;
    last_ = time;
    const double frames = std::round(elapsed * 60);
    return frames >= 1 && std::abs(elapsed * 60 - frames) < 0.2 ? frames / 60 : elapsed;
  }
  /// To be called in frames in which something moves, or somebody touches something.
  void stir() { stirred_ = last_; }
  /// s that the next frame may wait for somebody to do so: where nothing stirs, 30 pictures a second will do.
  double spare() const {
    constexpr double settling = 1, interval = 1.0 / 30;  // tooltips come within a second, and scrolling comes to rest
    return last_ - stirred_ > settling ? std::max(0.0, interval - (now() - last_)) : 0;
  }
  /// Without a monitor to wait for, frames would follow one another at once and heat the machine for nothing.
  void rest() const {
    constexpr double shortest = 1.0 / 125;
    const double left = shortest - (now() - last_);
    if (left > 0) std::this_thread::sleep_for(std::chrono::duration<double>(left));
  }

 private:
  double last_ = now(), stirred_ = last_;
};

}  // namespace app
