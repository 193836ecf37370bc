#include "app/session/stability/blow_up_monitor.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "softbody/contact/law.h"
#include "softbody/model/body_model.h"

namespace app::session {

void BlowUpMonitor::begin(const softbody::World& world, std::size_t bodies) {
  recent_.clear();
  rest_energy_.clear();
  mass_.clear();
  max_depth_.clear();
  fall_energy_ = 0;
  const double g = glm::length(world.scene().gravity);
  const softbody::BodyModel* last = nullptr;
  for (softbody::BodyId b = 0; b < bodies; ++b) {
    const softbody::BodyModel& p = world.model(b);
    rest_energy_.push_back(&p == last ? rest_energy_.back() : softbody::starting_energy(p).deformation());
    mass_.push_back(p.material[softbody::Material::mass]);
    max_depth_.push_back(max_depth * p.radius);
    fall_energy_ += p.material[softbody::Material::mass] * g * p.radius;
    last = &p;
  }
  fall_speed_ = g * static_cast<double>(memory) * world.frame_time();
}

/// Adds the energy that penalty contacts hold at the start, because a body may have been added where another one is.
/// They return it as they push the two apart.
void BlowUpMonitor::add_contact_energy(const softbody::World& world, FrameTotals& first) const {
  const double held = softbody::total(world.pair_energies().next);
  first.energy += held;
  if (held > 0) first.bounce = std::max(first.bounce, std::sqrt(2 * held / *std::ranges::min_element(mass_)));
}

/// Updates whether surfaces that overlapped at the start still separate.
void BlowUpMonitor::update_separating(const softbody::World& world, FrameTotals& now) {
  separating_ = world.last_step().adds_energy ? std::max(separating_, 1) - 1 : 0;
  if (separating_ == 0) return;
  now.pushed = true;
  now.bounce = std::max(now.bounce, 2 * softbody::law::max_separation_speed);  // elastic bodies bounce off
}

BlowUpMonitor::FrameTotals BlowUpMonitor::totals_of(const std::vector<softbody::BodyMeasures>& bodies) const {
  FrameTotals sum{};
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const softbody::Energy& e = bodies[b].energy;
    const double stored = std::max(0.0, e.deformation() - rest_energy_[b]);
    sum.energy += e.total() + bodies[b].staggering;
    sum.active += e.kinetic + stored;
    sum.speed = std::max(sum.speed, bodies[b].max_speed);
    sum.bounce = std::max(sum.bounce, std::sqrt(2 * stored / mass_[b]));
    sum.pushed = sum.pushed || bodies[b].deepest_penetration > max_depth_[b];
  }
  return sum;
}

BlowUpMonitor::FrameTotals BlowUpMonitor::recent_maximum() const {
  assert(!recent_.empty());
  FrameTotals max = recent_.front();
  for (const FrameTotals& t : recent_)
    max = {std::max(max.energy, t.energy), std::max(max.active, t.active), std::max(max.speed, t.speed),
           std::max(max.bounce, t.bounce), false};
  return max;
}

/// Returns the body that has gained most energy since the last check.
softbody::BodyId BlowUpMonitor::body_with_largest_gain(const std::vector<softbody::BodyMeasures>& bodies) const {
  std::size_t found = 0;
  const auto gain = [&](std::size_t b) { return bodies[b].energy.total() + bodies[b].staggering - last_energy_[b]; };
  for (std::size_t b = 1; b < bodies.size(); ++b)
    if (gain(b) > gain(found)) found = b;
  return static_cast<softbody::BodyId>(found);
}

std::optional<BlowUp> BlowUpMonitor::find_blow_up(const FrameTotals& now,
                                                  const std::vector<softbody::BodyMeasures>& bodies, int frame) const {
  const FrameTotals recent = recent_maximum();
  const double reach = max_speed_factor * (recent.speed + recent.bounce + fall_speed_) + rounding_velocity;
  if (now.speed > reach) {
    const auto fastest = std::ranges::max_element(bodies, {}, &softbody::BodyMeasures::max_speed);
    const auto body = static_cast<softbody::BodyId>(fastest - bodies.begin());
    return BlowUp{body, frame,
                  fmt::format("Body {} moves at {:.3g} m/s, and {:.3g} m/s is all that could be reached", body,
                              now.speed, reach)};
  }
  if (recent_.back().pushed) return {};
  const double mass = std::accumulate(mass_.begin(), mass_.end(), 0.0);
  const double energy =
      recent.energy + max_gain * (recent.active + fall_energy_) + 0.5 * mass * rounding_velocity * rounding_velocity;
  if (now.energy <= energy) return {};
  const softbody::BodyId body = body_with_largest_gain(bodies);
  return BlowUp{body, frame,
                fmt::format("Body {} gained energy from nothing: all bodies have {:.3g} J more than there can be", body,
                            now.energy - energy)};
}

std::optional<BlowUp> BlowUpMonitor::check(const softbody::World& world,
                                           const std::vector<softbody::BodyMeasures>& bodies) {
  assert(bodies.size() == world.bodies().count());
  const auto lost = std::ranges::find(bodies, false, &softbody::BodyMeasures::finite);
  if (lost != bodies.end()) {
    const auto body = static_cast<softbody::BodyId>(lost - bodies.begin());
    return BlowUp{body, world.frame(), fmt::format("Body {} is no longer finite", body)};
  }
  std::size_t held = 0;
  for (softbody::BodyId b = 0; b < bodies.size(); ++b) held += world.body(b).pinned;
  if (bodies.size() != mass_.size() || held != held_count_ || recent_.empty()) begin(world, bodies.size());
  held_count_ = held;
  FrameTotals now = totals_of(bodies);
  std::optional<BlowUp> blow_up;
  if (recent_.empty()) {
    add_contact_energy(world, now);
    separating_ = static_cast<int>(memory) + 1;
  }
  update_separating(world, now);
  if (!recent_.empty()) blow_up = find_blow_up(now, bodies, world.frame());
  recent_.push_back(now);
  if (recent_.size() > memory) recent_.pop_front();
  last_energy_.clear();
  for (const softbody::BodyMeasures& b : bodies) last_energy_.push_back(b.energy.total() + b.staggering);
  return blow_up;
}

}  // namespace app::session
