#pragma once
// A sweep over a copy of one frame on a thread of its own: the demo goes on meanwhile, and never waits for it.

#include <mutex>
#include <thread>

#include "app/compare/positions.h"
#include "app/compare/sweep.h"

namespace app {

/// The latest sweep, as far as it has come.
struct SweepState {
  std::string scene;  // name of the one that the frame was copied from; empty: nothing swept yet
  int frame = 0;      // of that scene's world
  bool running = false;
  double progress = 0;      // 0 .. 1
  std::string stop_reason;  // why it ended before its time, else empty
  SweepReport report;       // of a running sweep: what is known so far
};

class SweepWorker {
 public:
  /// Steps predicted to take some tenths of a second at most, so that a cancelled sweep ends soon and the window closes
  /// without a long wait. In the largest scene some take a few seconds all the same.
  static constexpr SweepLimits live_limits{.budget = 200'000'000, .repeat_ms = 250};

  explicit SweepWorker(const SweepLimits& limits = live_limits) : limits_(limits) {}

  /// Copies the world's present frame and sweeps it; the world may change or go meanwhile. Does nothing while a sweep
  /// is running. What goes wrong is told by the state. The thread rests after each step for as long as that took, so
  /// that it never takes more than half a core from the simulation and the drawing.
  void start(const softbody::World& world);
  /// The sweep ends after the step under way; what it knows by then stays.
  void cancel() { thread_.request_stop(); }
  /// Cancelled, and that step still goes on.
  bool cancelling() const { return running_ && thread_.get_stop_token().stop_requested(); }
  /// The state, if it has changed since the last call.
  std::optional<SweepState> take();

 private:
  struct Job {
    Positions at;
    collide::Bodies bodies;
    std::vector<Configuration> configurations;
    SweepState state;
  };

  void run(const std::stop_token& stop, Job& job);
  void publish(SweepState&& state);
  void publish_progress(SweepState& state, const Sweep& sweep);

  const SweepLimits limits_;
  bool running_ = false;  // as the caller knows it from take()
  std::mutex mutex_;      // guards news_
  std::optional<SweepState> news_;
  std::jthread thread_;  // last: joined before all else goes
};

}  // namespace app
