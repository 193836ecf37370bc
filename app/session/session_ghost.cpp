// Session: the second world.

#include "app/session/session.h"

namespace app {

void Session::set_ghost(const std::optional<softbody::IntegratorChoice>& choice) {
  notice_.clear();
  ++revision_;
  history_.ghost.clear();
  std::unique_ptr<Ghost> before = std::move(ghost_);
  if (!choice) return;
  try {
    ghost_ = std::make_unique<Ghost>(*world_, *choice, threads_);
  } catch (const std::exception& error) {
    ghost_ = std::move(before);
    notice_ = error.what();
  }
}

/// Something has changed the world from outside.
void Session::intervened() {
  stability_.intervened();
  restart_ghost();
}

void Session::restart_ghost() {
  if (!ghost_) return;
  history_.ghost.clear();
  try {
    ghost_->restart(*world_);
  } catch (const std::exception& error) {
    ghost_.reset();
    notice_ = error.what();
  }
}

/// After a step of the world.
void Session::step_ghost() {
  if (!ghost_) return;
  if (world_->grabbed()) return;  // it has begun anew
  try {
    ghost_->step();
  } catch (const std::exception& error) {
    ghost_.reset();
    notice_ = error.what();
    return;
  }
  if (ghost_->blown_up()) return;
  if (ghost_->world().last_step().seconds != world_->last_step().seconds) return restart_ghost();  // one was cut short
  history_.ghost.push(world_->frame(), static_cast<float>(ghost_->distance(*world_)));
  if (!ghost_->world().all_at_rest()) ++revision_;
}

}  // namespace app
