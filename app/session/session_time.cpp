// Session: how the world follows real time.

#include "app/session/session.h"

#include <algorithm>
#include <cmath>

namespace app {

/// What the last action met with need not be said for ever.
void Session::age_notice(double elapsed) {
  constexpr double longest = 20;  // s
  notice_age_ = notice_ == aged_notice_ ? notice_age_ + std::min(elapsed, longest_elapsed) : 0;
  if (notice_age_ > longest) notice_.clear();
  aged_notice_ = notice_;
}

void Session::advance(double elapsed) {
  age_notice(elapsed);
  history_.frame_ms.push(world_->frame(), static_cast<float>(elapsed * 1e3));
  if (step_once_) {
    step_once_ = false;
    step();
  } else if (!paused) {
    run(elapsed);
  }
  follow();
}

void Session::advance_one(double elapsed, bool one) {
  age_notice(elapsed);
  history_.frame_ms.push(world_->frame(), static_cast<float>(elapsed * 1e3));
  if (one && (!paused || step_once_)) {
    step_once_ = false;
    accumulator_ = 0;
    step();
  }
  follow();
}

/// What is known about the world comes after it.
void Session::follow() {
  exchange_comparison();
  if (judges_surfaces)
    surfaces_.exchange(*world_, before_last_step_, revision_, rests());
  else
    surfaces_.restart(revision_);
}

int Session::rests() const {
  constexpr float late_ms = 25;  // fewer than 40 pictures a second
  return history_.frame_ms.median(15) > late_ms ? 10 : 2;
}

void Session::run(double elapsed) {
  const double frame = world_->frame_time();
  const double asked = std::clamp(elapsed, 0.0, longest_elapsed) * (slow_motion ? slow_factor : 1.0);
  accumulator_ += asked;
  int steps = 0;
  double spent_ms = 0, done = 0;
  const double budget_ms = std::max(step_budget_ms, step_budget_part * 1e3 * elapsed);
  while (!paused && accumulator_ >= frame && steps < most_steps && spent_ms < budget_ms) {
    step();
    accumulator_ -= frame;
    done += world_->profile().seconds;
    spent_ms += step_ms();
    ++steps;
  }
  // What is still owed is dropped: paying it back would make the next call longer, and the one after that (a spiral).
  if (accumulator_ >= frame) accumulator_ = std::fmod(accumulator_, frame);
  follow_pace(asked, done);
}

double Session::step_ms() const {
  return world_->profile().total_ms + (ghost_ ? ghost_->world().profile().total_ms : 0);
}

void Session::follow_pace(double asked, double done) {
  asked_ += asked;
  done_ += done;
  const double window = slow_motion ? 0.5 * slow_factor : 0.5;
  if (asked_ < std::max(window, 4 * world_->frame_time())) return;
  pace_ = std::min(1.0, done_ / asked_);
  asked_ = done_ = 0;
}

float Session::between() const {
  if (!slow_motion || paused || world_->all_at_rest()) return 1.0f;
  return static_cast<float>(std::clamp(accumulator_ / world_->frame_time(), 0.0, 1.0));
}

DrawnPositions Session::drawn_positions(bool whole_steps) const {
  const Positions& before = before_last_step_;
  return {world_->positions(), before.x, before.y, before.z, whole_steps ? 1.0f : between()};
}

void Session::single_step() {
  paused = true;
  step_once_ = true;
}

void Session::step() {
  before_last_step_.copy(world_->positions());
  const bool was_at_rest = world_->all_at_rest();
  if (!paused) stability_.dismiss_blow_up();
  const bool alarmed = stability_.blow_up().has_value();
  stability_.before_step(*world_);
  const bool stepped = succeeds([&] { world_->step(); });
  if (world_->grabbed()) intervened();  // a hand brings energy
  stability_.after_step(*world_, pause_on_blow_up);
  if (stability_.blow_up() && !alarmed) paused = true;
  step_ghost();
  if (!stepped || !was_at_rest || !world_->all_at_rest()) ++revision_;
  history_.detect_ms.push(world_->frame(), static_cast<float>(world_->profile().detect_ms));
  history_.solve_ms.push(world_->frame(), static_cast<float>(world_->profile().solve_ms));
  history_.contacts.push(world_->frame(), static_cast<float>(world_->detection().contacts.size()));
}

}  // namespace app
