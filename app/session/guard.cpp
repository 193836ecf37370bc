#include "app/session/guard.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace app {

void Guard::begin(const softbody::World& world, std::size_t bodies) {
  looks_.clear();
  resting_.clear();
  mass_.clear();
  deep_.clear();
  fall_ = 0;
  const double g = glm::length(world.scene().gravity);
  const softbody::Prototype* last = nullptr;
  for (softbody::BodyId b = 0; b < bodies; ++b) {
    const softbody::Prototype& p = world.prototype(b);
    resting_.push_back(&p == last ? resting_.back() : softbody::starting_energy(p).deformation());
    mass_.push_back(p.material.mass);
    deep_.push_back(deep * p.radius);
    fall_ += p.material.mass * g * p.radius;
    last = &p;
  }
  gravity_ = g * static_cast<double>(memory) * world.frame_time();
}

/// What shields hold as it begins, for a body may have come where another is: they give back the work of their push.
void Guard::add_shields(const softbody::World& world, Look& first) const {
  const double held = softbody::total(world.shield_energies());
  first.energy += held;
  if (held > 0) first.bounce = std::max(first.bounce, std::sqrt(2 * held / *std::ranges::min_element(mass_)));
}

/// Notes whether surfaces that lay in each other as it began still come apart.
void Guard::follow_parting(const softbody::World& world, Look& now) {
  parting_ = world.dynamics().surface_contact().gives_energy() ? std::max(parting_, 1) - 1 : 0;
  if (parting_ == 0) return;
  now.pushed = true;
  now.bounce = std::max(now.bounce, 2 * double(softbody::SurfaceContact::push_speed));  // elastic bodies are thrown off
}

Guard::Look Guard::sum_up(const std::vector<softbody::BodyMeasures>& bodies) const {
  Look look{};
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const softbody::Energy& e = bodies[b].energy;
    const double stored = std::max(0.0, e.deformation() - resting_[b]);
    look.energy += e.total() + bodies[b].staggering;
    look.active += e.kinetic + stored;
    look.speed = std::max(look.speed, bodies[b].max_speed);
    look.bounce = std::max(look.bounce, std::sqrt(2 * stored / mass_[b]));
    look.pushed = look.pushed || bodies[b].deepest_penetration > deep_[b];
  }
  return look;
}

Guard::Look Guard::most_of_late() const {
  Look most = looks_.front();
  for (const Look& l : looks_)
    most = {std::max(most.energy, l.energy), std::max(most.active, l.active), std::max(most.speed, l.speed),
            std::max(most.bounce, l.bounce), false};
  return most;
}

/// The body that gained most since the last look.
softbody::BodyId Guard::culprit(const std::vector<softbody::BodyMeasures>& bodies) const {
  std::size_t found = 0;
  const auto gain = [&](std::size_t b) { return bodies[b].energy.total() + bodies[b].staggering - body_energy_[b]; };
  for (std::size_t b = 1; b < bodies.size(); ++b)
    if (gain(b) > gain(found)) found = b;
  return static_cast<softbody::BodyId>(found);
}

std::optional<Alarm> Guard::judge(const Look& now, const std::vector<softbody::BodyMeasures>& bodies, int frame) const {
  const Look most = most_of_late();
  const double reach = most_speed * (most.speed + most.bounce + gravity_) + tremble;
  if (now.speed > reach) {
    const auto fastest = std::ranges::max_element(bodies, {}, &softbody::BodyMeasures::max_speed);
    const auto body = static_cast<softbody::BodyId>(fastest - bodies.begin());
    return Alarm{body, frame,
                 fmt::format("Body {} moves at {:.3g} m/s, and {:.3g} m/s is all that could be reached", body,
                             now.speed, reach)};
  }
  if (looks_.back().pushed) return {};
  const double mass = std::accumulate(mass_.begin(), mass_.end(), 0.0);
  const double energy = most.energy + most_gain * (most.active + fall_) + 0.5 * mass * tremble * tremble;
  if (now.energy <= energy) return {};
  const softbody::BodyId body = culprit(bodies);
  return Alarm{body, frame,
               fmt::format("Body {} gained energy from nothing: all bodies have {:.3g} J more than there can be", body,
                           now.energy - energy)};
}

std::optional<Alarm> Guard::look(const softbody::World& world, const std::vector<softbody::BodyMeasures>& bodies) {
  const auto lost = std::ranges::find(bodies, false, &softbody::BodyMeasures::finite);
  if (lost != bodies.end()) {
    const auto body = static_cast<softbody::BodyId>(lost - bodies.begin());
    return Alarm{body, world.frame(), fmt::format("Body {} is no longer finite", body)};
  }
  std::size_t held = 0;
  for (softbody::BodyId b = 0; b < bodies.size(); ++b) held += world.body(b).held;
  if (bodies.size() != mass_.size() || held != held_ || looks_.empty()) begin(world, bodies.size());
  held_ = held;
  Look now = sum_up(bodies);
  std::optional<Alarm> alarm;
  if (looks_.empty()) {
    add_shields(world, now);
    parting_ = static_cast<int>(memory) + 1;
  }
  follow_parting(world, now);
  if (!looks_.empty()) alarm = judge(now, bodies, world.frame());
  looks_.push_back(now);
  if (looks_.size() > memory) looks_.pop_front();
  body_energy_.clear();
  for (const softbody::BodyMeasures& b : bodies) body_energy_.push_back(b.energy.total() + b.staggering);
  return alarm;
}

}  // namespace app
