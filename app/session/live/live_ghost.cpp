#include "app/session/live/live_ghost.h"

namespace app::session {

std::string LiveGhost::choose(const softbody::World& world, const std::optional<softbody::IntegratorChoice>& choice,
                              int threads) try {
  ghost_ = choice ? std::make_unique<Ghost>(world, *choice, threads) : nullptr;
  distances_.clear();
  ++revision_;
  return {};
} catch (const std::exception& error) {
  return error.what();
}

std::string LiveGhost::restart(const softbody::World* world) try {
  ++revision_;
  distances_.clear();
  if (!world) ghost_.reset();
  if (ghost_) ghost_->restart(*world);
  return {};
} catch (const std::exception& error) {
  ghost_.reset();
  return error.what();
}

std::string LiveGhost::step(const softbody::World& world) try {
  // While a hand holds a body the ghost begins anew with each step.
  if (!ghost_ || ghost_->blown_up() || world.grabbed()) return {};
  ghost_->step();
  if (!ghost_->world().all_at_rest()) ++revision_;
  if (ghost_->blown_up()) return {};
  if (ghost_->world().last_step().seconds != world.last_step().seconds) return restart(&world);  // one was cut short
  distances_.push(world.frame(), static_cast<float>(ghost_->distance(world)));
  return {};
} catch (const std::exception& error) {
  ghost_.reset();
  return error.what();
}

}  // namespace app::session
