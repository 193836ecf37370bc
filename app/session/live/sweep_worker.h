#pragma once
// Runs a sweep over a copy of one frame on a thread of its own. The demo continues and never waits for it.

#include <mutex>
#include <thread>

#include "app/compare/positions.h"
#include "app/compare/sweep.h"

namespace app::session {

/// The latest sweep and its progress.
struct SweepState {
  std::string scene;  // name of the scene of the frame; empty: no sweep yet
  int frame = 0;      // of that scene's world
  bool running = false;
  double progress = 0;          // 0 .. 1
  std::string stop_reason;      // why it ended early, else empty
  compare::SweepReport report;  // of a running sweep: the results so far
};

class SweepWorker {
 public:
  /// Limits each step to a predicted few tenths of a second, so that a cancelled sweep ends soon and the window closes
  /// quickly. In the largest scene some steps take a few seconds nevertheless.
  static constexpr compare::SweepLimits live_limits{.budget = 200'000'000, .repeat_ms = 250};

  explicit SweepWorker(const compare::SweepLimits& limits = live_limits) : limits_(limits) {}

  /// Copies the world's present frame and sweeps the methods over it; the world may change or end meanwhile. Does
  /// nothing while a sweep is running. The state reports errors. After each step the thread rests as long as the step
  /// took, so that it takes at most half a core from the simulation and the drawing.
  void start(const softbody::BodiesInMotion& world, const compare::MethodSet& methods);
  /// Ends the sweep after the current step. The results so far stay.
  void cancel() { thread_.request_stop(); }
  /// Returns true if the sweep is cancelled and its current step still runs.
  bool cancelling() const { return running_ && thread_.get_stop_token().stop_requested(); }
  /// Returns the state if it has changed since the last call.
  std::optional<SweepState> take();

 private:
  void run(const std::stop_token& stop, const compare::FrameCopy& frame,
           const std::vector<compare::Configuration>& configurations, SweepState state);
  void publish(SweepState state);
  void publish_progress(SweepState& state, const compare::Sweep& sweep);

  const compare::SweepLimits limits_;
  bool running_ = false;  // as last reported by take()
  std::mutex mutex_;      // guards news_
  std::optional<SweepState> news_;
  std::jthread thread_;  // last member: ends before the others go
};

}  // namespace app::session
