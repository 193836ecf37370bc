#include "app/session/live/ghost.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "softbody/model/body_model.h"
#include "softbody/world/snapshot.h"

namespace app::session {

Ghost::Ghost(const softbody::World& of, const softbody::IntegratorChoice& choice, int threads)
    : choice_(choice), world_(softbody::Scene(), {.threads = threads, .frame_time = of.frame_time()}) {
  restart(of);
}

void Ghost::restart(const softbody::World& of) {
  world_.restore(of.snapshot());
  if (choice_ != world_.integrator_choice()) world_.set_integrator(choice_);
  before_.copy(world_.positions());
  blown_up_ = false;
}

void Ghost::step() {
  assert(!blown_up_);
  before_.copy(world_.positions());
  world_.step();
  constexpr float far = 1e4f;  // m
  const collide::Frame f = world_.positions();
  const auto lost = [](float at) { return !(std::abs(at) < far); };
  blown_up_ = std::ranges::any_of(f.x, lost) || std::ranges::any_of(f.y, lost) || std::ranges::any_of(f.z, lost);
}

double Ghost::distance(const softbody::World& of) const {
  const collide::Frame here = world_.positions(), there = of.positions();
  const collide::Bodies& bodies = of.bodies();
  double sum = 0;
  for (softbody::BodyId b = 0; b < bodies.count(); ++b) {
    double body = 0;
    for (collide::Index i = bodies.first[b]; i < bodies.first[b + 1]; ++i) {
      const glm::dvec3 d(here.x[i] - there.x[i], here.y[i] - there.y[i], here.z[i] - there.z[i]);
      body += d.x * d.x + d.y * d.y + d.z * d.z;
    }
    const double radius = of.model(b).radius;
    sum += body / (radius * radius);
  }
  return bodies.vertex_count() == 0 ? 0 : std::sqrt(sum / bodies.vertex_count());
}

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
