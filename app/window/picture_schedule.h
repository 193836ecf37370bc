#pragma once
// When pictures of the window are drawn. Where nothing changes, the window waits for events.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace app::window {

/// What asks for another picture, input aside.
struct Activity {
  bool moving = false;     // the picture or the interface changes with each picture
  bool counting = false;   // only numbers do: the world takes steps at rest, or a sweep goes on
  bool reporting = false;  // a file is read or written, and the interface says how far
  bool typing = false;     // a text cursor blinks
  bool has_news = false;   // the interface has other texts, and takes another frame to fit them
};

/// Returns the seconds from one picture to the next that these ask for; infinity if nothing changes.
inline double seconds_to_next_picture(const Activity& activity) {
  constexpr double counting = 1.0 / 30, reporting = 0.25, typing = 0.4;
  double seconds = std::numeric_limits<double>::infinity();
  if (activity.typing) seconds = std::min(seconds, typing);
  if (activity.reporting) seconds = std::min(seconds, reporting);
  if (activity.counting) seconds = std::min(seconds, counting);
  return activity.moving || activity.has_news ? 0 : seconds;
}

/// Times are seconds of one steady clock, given by the caller.
class PictureSchedule {
 public:
  /// Longer waits interrupt the world: it goes on afterwards as if no time had passed.
  static constexpr double max_running_wait = 1.0 / 30;

  explicit PictureSchedule(double now) : due_(now), active_(now) {}

  /// The user did something: the next picture is due. Pictures follow each other for a while, because tooltips appear
  /// and scrolling ends within a second.
  void input(double now) { due_ = active_ = now; }
  /// A picture was drawn.
  void drawn(double now, const Activity& activity) {
    constexpr double settling = 1;
    if (activity.moving) active_ = now;
    due_ = now - active_ <= settling ? now : now + seconds_to_next_picture(activity);
  }
  bool due(double now) const { return now >= due_; }
  /// Returns how long to wait for events before due() is asked again. `awaits_answer`: a thread may have an answer
  /// soon, and nobody else wakes the window for it.
  double wait(double now, bool awaits_answer) const {
    constexpr double max_wait = 0.25;
    return std::clamp(due_ - now, 0.0, awaits_answer ? max_running_wait : max_wait);
  }

 private:
  double due_, active_;
};

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

 private:
  double last_ = now();
};

}  // namespace app::window
