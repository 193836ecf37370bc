#include "app/session/stability/stability_monitor.h"

#include <algorithm>
#include <cmath>

namespace app::session {
namespace {

/// Returns the energy of springs and gas in the starting shapes of all bodies.
softbody::StoredEnergy energy_at_start(const softbody::World& world) {
  softbody::StoredEnergy sum;
  for (softbody::BodyId b = 0; b < world.bodies().count(); ++b) {
    const softbody::StoredEnergy& one = world.model(b).start_energy;
    sum.elastic += one.elastic;
    sum.gas += one.gas;
  }
  return sum;
}

StepMargin margin_of(const softbody::World& world) {
  const softbody::StepReport& last = world.last_step();
  if (last.substeps == 0) return {};
  return {.taken = last.substeps,
          .needed = last.needed,
          .substep = last.seconds / last.substeps,
          .bound = world.frame_time() / last.needed,
          .reserve = last.integrator->reserve(),
          .kind = last.integrator->stable_at_any_step() ? StepMargin::Bound::unconditional
                  : last.integrator->by_damping         ? StepMargin::Bound::by_damping
                                                        : StepMargin::Bound::stable,
          .share = last.seconds / world.frame_time()};
}

}  // namespace

bool StabilityMonitor::before_step(const softbody::World& world) {
  if (recovery_checks_ > 0 || !looks_at(world)) return false;
  rewind_.keep(world);
  return true;
}

void StabilityMonitor::after_step(const softbody::World& world, bool monitored) {
  margin_ = margin_of(world);
  if (!looks_at(world)) return;
  const auto bodies = softbody::measure_bodies(world);
  record(world, bodies);
  if (!monitored) return blow_up_monitor_.restart();
  auto found = blow_up_monitor_.check(world, bodies);
  if (found) {
    if (recovery_checks_ == 0) blow_up_ = std::move(found);  // a blow-up that continues is one blow-up
    recovery_checks_ = recovery;
  } else if (recovery_checks_ > 0) {
    --recovery_checks_;
  } else if (blow_up_monitor_.compared()) {
    good_frame_ = world.frame();
  }
}

void StabilityMonitor::record(const softbody::World& world, const std::vector<softbody::BodyMeasures>& bodies) {
  constexpr double max_shown = 1e30;  // a world that has blown up is no longer drawn
  const softbody::Measures all = softbody::total(bodies);
  const softbody::StoredEnergy start = energy_at_start(world);
  for (std::size_t i = 0; i < history_.size(); ++i)
    if (const double value = stability_quantities[i].of(all, start); std::abs(value) < max_shown)
      history_[i].push(world.frame(), static_cast<float>(value));
}

void StabilityMonitor::restart(const softbody::World& world) {
  *this = {};
  record(world, softbody::measure_bodies(world));
}

void StabilityMonitor::went_back(const softbody::World& world) {
  blow_up_monitor_.restart();
  good_frame_ = std::min(good_frame_, world.frame());
  blow_up_.reset();
  recovery_checks_ = 0;
  margin_ = {};
  for (TimeSeries& series : history_) series.forget_from(world.frame());
  record(world, softbody::measure_bodies(world));
}

bool StabilityMonitor::keep_present(const softbody::World& world) {
  const bool past = !rewind_.snapshots().empty() && world.frame() <= rewind_.snapshots().back().frame;
  if (recovery_checks_ > 0 || past) return false;
  rewind_.keep(world);
  return true;
}

}  // namespace app::session
