#pragma once
// Runs a sweep over a copy of one frame, beside the demo, which never waits for it.

#include "app/base/background.h"
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

/// Checks or times one configuration a part. A task for Background.
class SweepTask {
 public:
  struct Question {
    SweepState state;  // at the start
    compare::FrameCopy frame;
    std::vector<compare::Configuration> configurations;
  };
  using Answer = SweepState;
  static constexpr int rests = 1;  // so the sweep takes at most half a core from the simulation and the drawing

  explicit SweepTask(const compare::SweepLimits& limits) : limits_(limits) {}
  std::optional<SweepState> advance(const Question& question, Background<SweepTask>& background);

 private:
  compare::SweepLimits limits_;
  collide::Workers alone_{1};
  std::optional<compare::Sweep> sweep_;  // of the question at hand
};

class SweepWorker {
 public:
  /// Limits each step to a predicted few tenths of a second, so that a cancelled sweep ends soon and the window closes
  /// quickly. In the largest scene some steps take a few seconds nevertheless.
  static constexpr compare::SweepLimits live_limits{.budget = work_of_part(200'000'000), .repeat_ms = 250};

  explicit SweepWorker(const compare::SweepLimits& limits = live_limits, Runs runs = usual_runs)
      : sweep_(runs, limits) {}

  /// Copies the world's present frame and sweeps the methods over it; the world may change or end meanwhile. Does
  /// nothing while a sweep is running. The state reports errors.
  void start(const softbody::BodiesInMotion& world, const compare::MethodSet& methods);
  /// Returns true if the latest sweep is of the world's present frame.
  bool knows(const softbody::BodiesInMotion& world) const {
    return state_.scene == world.scene().name && state_.frame == world.frame();
  }
  /// Ends the sweep after the current step. The results so far stay.
  void cancel() { sweep_.cancel(); }
  /// Returns true if the sweep is cancelled and its current step still runs.
  bool cancelling() const { return state_.running && sweep_.cancelled(); }
  /// Takes over how far the sweep has got.
  void update();
  /// Returns the latest sweep, as update() found it.
  const SweepState& state() const { return state_; }

 private:
  SweepState state_;
  Background<SweepTask> sweep_;
};

}  // namespace app::session
