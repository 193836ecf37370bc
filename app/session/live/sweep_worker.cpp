#include "app/session/live/sweep_worker.h"

#include <chrono>
#include <condition_variable>
#include <utility>

namespace app::session {
namespace {

using Clock = std::chrono::steady_clock;

/// Waits; returns early if a stop is requested.
void rest(Clock::duration duration, const std::stop_token& stop) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any().wait_for(lock, stop, duration, [] { return false; });
}

}  // namespace

void SweepWorker::start(const softbody::BodiesInMotion& world, const compare::MethodSet& methods) {
  if (running_) return;
  SweepState state{
      .scene = world.scene().name, .frame = world.frame(), .running = true, .stop_reason = {}, .report = {}};
  try {
    compare::FrameCopy frame;
    frame.copy(world.positions());
    publish(state);
    thread_ = std::jthread(
        [this, state, frame = std::move(frame), configurations = compare::sweep_configurations(world, methods)](
            const std::stop_token& stop) { run(stop, frame, configurations, state); });
    running_ = true;
  } catch (const std::exception& error) {  // too little memory for the copy, or no thread available
    state.running = false;
    state.stop_reason = error.what();
    publish(std::move(state));
  }
}

std::optional<SweepState> SweepWorker::take() {
  const std::scoped_lock lock(mutex_);
  if (news_) running_ = news_->running;
  return std::exchange(news_, std::nullopt);
}

void SweepWorker::run(const std::stop_token& stop, const compare::FrameCopy& frame,
                      const std::vector<compare::Configuration>& configurations, SweepState state) {
  try {
    collide::Workers alone(1);
    compare::Sweep sweep(frame.view(), configurations, limits_, alone);
    for (auto start = Clock::now(); !stop.stop_requested() && sweep.step(); start = Clock::now()) {
      publish_progress(state, sweep);
      rest(Clock::now() - start, stop);
    }
    state.progress = sweep.progress();
    if (state.progress < 1) state.stop_reason = "cancelled";
    state.report = sweep.report();
  } catch (const std::exception& error) {  // too little memory must not end the demo
    state.stop_reason = error.what();
  }
  state.running = false;
  publish(std::move(state));
}

void SweepWorker::publish(SweepState state) {
  const std::scoped_lock lock(mutex_);
  news_ = std::move(state);
}

/// Publishes only if the last news were taken: a step may take microseconds, and a copy of the report takes as long.
void SweepWorker::publish_progress(SweepState& state, const compare::Sweep& sweep) {
  const std::scoped_lock lock(mutex_);
  if (news_) return;
  state.progress = sweep.progress();
  state.report = sweep.report();
  news_ = state;
}

}  // namespace app::session
