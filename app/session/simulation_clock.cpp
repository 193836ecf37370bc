#include "app/session/simulation_clock.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace app::session {

bool SimulationClock::take_single_step(const Stepper& step) {
  if (!std::exchange(single_step_, false)) return false;
  step();
  return true;
}

void SimulationClock::advance(double elapsed, double frame_time, const Stepper& step) {
  assert(frame_time > 0);
  if (take_single_step(step) || paused) return;
  const bool ahead = running_ahead;
  const double requested = std::clamp(elapsed, 0.0, max_elapsed) * factor();
  const double budget_ms = std::max(step_budget_ms, step_budget_share * 1e3 * elapsed);
  owed_ += requested;
  double spent_ms = 0, done = 0;
  for (int steps = 0; !paused && owed_ >= frame_time && steps < max_steps && spent_ms < budget_ms; ++steps) {
    const Step taken = step();
    owed_ -= frame_time;
    done += taken.seconds;
    spent_ms += taken.ms;
  }
  // What is still owed is dropped: paying it back would make the next call longer, and the one after that (a spiral).
  if (owed_ >= frame_time) owed_ = std::fmod(owed_, frame_time);
  if (ahead) return;
  requested_ += requested;
  done_ += done;
  if (requested_ < std::max(0.5 * factor(), 4 * frame_time)) return;
  pace_ = std::min(1.0, done_ / requested_);
  requested_ = done_ = 0;
}

void SimulationClock::advance_one(const Stepper& step) {
  if (take_single_step(step) || paused) return;
  owed_ = 0;
  step();
}

void SimulationClock::single_step() {
  paused = true;
  single_step_ = true;
}

void SimulationClock::restart() {
  owed_ = 0;
  single_step_ = false;
}

double SimulationClock::fraction(double frame_time) const {
  return slow_motion || speed < 1 ? std::clamp(owed_ / frame_time, 0.0, 1.0) : 1.0;
}

}  // namespace app::session
