#include "app/session/run_ahead.h"

#include <exception>
#include <utility>

#include "app/base/timings.h"

namespace app::session {

void RunAhead::start(Goal reached, double max_seconds) {
  const softbody::BodiesInMotion& world = simulation_.world();
  run_ = {std::move(reached), world.last_step().time + max_seconds, world.frame()};
  simulation_.clock.running_ahead = true;
  simulation_.clock.paused = false;
  if (!goes_on()) stop();
}

void RunAhead::stop() {
  if (!std::exchange(run_, std::nullopt)) return;
  simulation_.clock.running_ahead = false;
  simulation_.clock.paused = true;
}

double RunAhead::stepped() {
  if (!run_) return 0;
  return time_ms([this] {
    const bool failed = std::exchange(run_->frame, simulation_.world().frame()) == simulation_.world().frame();
    if (failed || simulation_.clock.paused || !goes_on()) stop();
  });
}

bool RunAhead::goes_on() const {
  const softbody::BodiesInMotion& world = simulation_.world();
  if (world.all_at_rest() || world.last_step().time >= run_->end) return false;
  try {
    return !run_->reached(world);
  } catch (const std::exception& error) {
    simulation_.notice.set(error.what());
    return false;
  }
}

}  // namespace app::session
