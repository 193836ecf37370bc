#include "app/session/live/sweep_worker.h"

#include <utility>

#include "app/base/text.h"

namespace app::session {

std::optional<SweepState> SweepTask::advance(const Question& question, Background<SweepTask>& background) {
  SweepState state = question.state;
  try {
    if (!sweep_) sweep_.emplace(question.frame.view(), question.configurations, limits_, alone_);
    if (!background.cancelled() && sweep_->step()) {
      if (!background.was_taken()) return std::nullopt;  // a step may take microseconds, and a copy takes as long
      state.progress = sweep_->progress();
      state.report = sweep_->report();
      background.publish(std::move(state));
      return std::nullopt;
    }
    if (sweep_->progress() < 1) state.stop_reason = "cancelled";
  } catch (const std::exception& error) {
    state.stop_reason = "failed: " + failure_text(error);
  }
  state.running = false;
  if (sweep_) {
    state.progress = sweep_->progress();
    state.report = sweep_->take_report();
    sweep_.reset();
  }
  return state;
}

void SweepWorker::start(const softbody::BodiesInMotion& world, const compare::MethodSet& methods) {
  if (state_.running) return;
  state_ = {.scene = world.scene().name, .frame = world.frame(), .running = true, .stop_reason = {}, .report = {}};
  try {
    compare::FrameCopy frame;
    frame.copy(world.positions());
    sweep_.offer({state_, std::move(frame), compare::sweep_configurations(world, methods)});
  } catch (const std::exception& error) {  // too little memory for the copy
    state_.running = false;
    state_.stop_reason = "failed: " + failure_text(error);
  }
}

void SweepWorker::update() {
  if (std::optional<SweepState> news = sweep_.take()) state_ = std::move(*news);
}

}  // namespace app::session
