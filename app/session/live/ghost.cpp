#include "app/session/live/ghost.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "softbody/model/body_model.h"
#include "softbody/world/snapshot.h"

namespace app::session {
namespace {

/// Brings a world to the present state of `of`, from which this integrator moves it.
void bring_to(softbody::World& ghost, const softbody::World& of, const softbody::IntegratorChoice& choice) {
  ghost.restore(of.snapshot());
  if (choice != ghost.integrator_choice()) ghost.set_integrator(choice);
}

}  // namespace

void Ghost::choose(const softbody::World& of, const std::optional<softbody::IntegratorChoice>& choice, int threads) {
  std::unique_ptr<softbody::World> chosen;
  if (choice) {
    chosen = std::make_unique<softbody::World>(
        softbody::Scene(), softbody::World::Options{.threads = threads, .frame_time = of.frame_time()});
    bring_to(*chosen, of, *choice);
  }
  compare::Positions before;
  if (chosen) before.copy(chosen->positions());
  world_ = std::move(chosen);
  before_ = std::move(before);
  restarted();
}

void Ghost::restart(const softbody::World* of) try {
  if (!of) world_.reset();
  if (world_) {
    bring_to(*world_, *of, softbody::IntegratorChoice(world_->integrator_choice()));
    before_.copy(world_->positions());
  }
  restarted();
} catch (...) {
  end();
  throw;
}

void Ghost::step(const softbody::World& of) try {
  // While a hand holds a body the ghost begins anew with each step.
  if (!world_ || blown_up_ || of.grabbed()) return;
  before_.copy(world_->positions());
  world_->step();
  if (!world_->all_at_rest()) ++revision_;
  constexpr float far = 1e4f;  // m
  const collide::Frame f = world_->positions();
  const auto lost = [](float at) { return !(std::abs(at) < far); };
  blown_up_ = std::ranges::any_of(f.x, lost) || std::ranges::any_of(f.y, lost) || std::ranges::any_of(f.z, lost);
  if (blown_up_) return;
  if (world_->last_step().seconds != of.last_step().seconds) return restart(&of);  // one was cut short
  distances_.push(of.frame(), static_cast<float>(distance(of)));
} catch (...) {
  end();
  throw;
}

/// Forgets what was found out about the ghost before.
void Ghost::restarted() {
  ++revision_;
  distances_.clear();
  blown_up_ = false;
}

void Ghost::end() {
  world_.reset();
  restarted();
}

double Ghost::distance(const softbody::World& of) const {
  assert(world_);
  const collide::Frame here = world_->positions(), there = of.positions();
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

}  // namespace app::session
