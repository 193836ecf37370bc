#pragma once
// Simulated time against real time.

#include <functional>

namespace app::session {

/// Decides how many frames of the world are due. Time that the machine cannot keep up with is dropped.
class SimulationClock {
 public:
  static constexpr double max_elapsed = 0.5;  // s of real time that one advance() looks at
  static constexpr int max_steps = 15;        // of one advance()
  // No further step begins in one advance() after this much time, or this share of the time between two pictures.
  static constexpr double step_budget_ms = 25, step_budget_share = 0.4;
  static constexpr double min_slow_factor = 0.02, max_slow_factor = 1.0;
  static constexpr double ahead_factor = 5;  // of real time, while running ahead

  struct Step {
    double seconds;  // simulated
    double ms;       // of real time that it took
  };
  using Stepper = std::function<Step()>;

  bool paused = false;  // `step` may set it
  bool slow_motion = false;
  double slow_factor = 0.1;    // min_slow_factor .. max_slow_factor, of real time, in slow motion
  double speed = 1;            // of real time, without slow motion; what is not simulated may run as fast as wanted
  bool running_ahead = false;  // by ahead_factor, also in slow motion; `step` may reset it

  /// Calls `step` for each frame of `frame_time` seconds that is due, now that `elapsed` seconds of real time have
  /// passed.
  void advance(double elapsed, double frame_time, const Stepper& step);
  /// Calls `step` once, unless paused, however much time has passed. For recordings.
  void advance_one(const Stepper& step);
  /// Pauses, and lets the next advance() take one step.
  void single_step();
  /// Returns true if the next advance() takes one step, though the world is paused.
  bool owes_single_step() const { return single_step_; }
  /// Another world: no time is owed.
  void restart();

  /// Simulated over requested time of the last half second. Below 1 the machine does not keep up, or frames are cut
  /// short.
  double pace() const { return pace_; }
  /// How far time is on the way to the next frame of `frame_time` seconds, 0 .. 1. Always 1 but where time is slowed.
  double fraction(double frame_time) const;

 private:
  bool take_single_step(const Stepper& step);
  double factor() const { return running_ahead ? ahead_factor : slow_motion ? slow_factor * speed : speed; }

  double owed_ = 0;  // s of simulated time, less than one frame after advance()
  bool single_step_ = false;
  double pace_ = 1, requested_ = 0, done_ = 0;  // s, since pace_ was measured
};

}  // namespace app::session
