#include "app/session/stability_watch.h"

#include <algorithm>
#include <cmath>

#include "softbody/prototype.h"

namespace app {
namespace {

/// Of springs and gas, in the starting shapes of all bodies.
softbody::Energy energy_at_start(const softbody::World& world) {
  softbody::Energy sum, one;
  const softbody::Prototype* last = nullptr;
  for (softbody::BodyId b = 0; b < world.bodies().count(); ++b) {
    const softbody::Prototype* p = &world.prototype(b);
    if (p != last) one = softbody::starting_energy(*p);
    last = p;
    sum += one;
  }
  return sum;
}

StepMargin::Bound kind_of(const softbody::Integrator& integrator) {
  if (std::isinf(integrator.stable_step(1, 0))) return StepMargin::Bound::unconditional;
  return integrator.by_damping ? StepMargin::Bound::by_damping : StepMargin::Bound::stable;
}

}  // namespace

void StabilityWatch::before_step(const softbody::World& world) {
  if (to_be_good_ == 0) rewind_.keep(world);
  needed_before_ = world.needed_substeps();
}

void StabilityWatch::after_step(const softbody::World& world, bool guarded) {
  const double frame = world.frame_time();
  // The bound changes within a frame as bodies move: the step is held against the wider of both ends.
  const softbody::StepReport& last = world.last_step();
  const int taken = last.substeps, needed = std::min(needed_before_, world.needed_substeps());
  margin_ = {};
  if (taken > 0)
    margin_ = {.taken = taken,
               .needed = needed,
               .substep = last.seconds / taken,
               .bound = frame / needed,
               .kind = kind_of(*last.integrator),
               .share = last.seconds / frame};
  const auto every = static_cast<int>(1 + world.bodies().vertex_count() / vertices_a_frame);
  if (world.frame() % every != 0) return;
  const bool staggered = taken > 0 && last.integrator->staggered;
  const auto bodies = softbody::measure_bodies(world, staggered ? last.last_substep : 0);
  record(world, bodies);
  if (!guarded) guard_.restart();
  if (guarded) judge(world, bodies);
}

void StabilityWatch::judge(const softbody::World& world, const std::vector<softbody::BodyMeasures>& bodies) {
  auto found = guard_.look(world, bodies);
  if (found) {
    if (to_be_good_ == 0) alarm_ = std::move(found);  // what goes on exploding is one explosion
    to_be_good_ = Guard::memory;
  } else if (to_be_good_ > 0) {
    --to_be_good_;
  } else if (guard_.judged()) {
    good_frame_ = world.frame();
  }
}

void StabilityWatch::record(const softbody::World& world, const std::vector<softbody::BodyMeasures>& bodies) {
  constexpr double most = 1e30;  // what has blown up is no longer drawn
  const int frame = world.frame();
  const softbody::Measures all = softbody::total(bodies);
  const softbody::Energy start = energy_at_start(world);
  const auto push = [frame](Ring& ring, double value) {
    if (std::abs(value) < most) ring.push(frame, static_cast<float>(value));
  };
  push(history_.kinetic, all.energies.kinetic);
  push(history_.elastic, all.energies.elastic - start.elastic);
  push(history_.gas, all.energies.gas - start.gas);
  push(history_.gravity, all.energies.gravity);
  push(history_.total, all.energy - start.deformation());
  push(history_.least_volume, all.volume_ratio_min);
  push(history_.most_volume, all.volume_ratio_max);
  push(history_.strain, all.largest_strain);
  push(history_.speed, all.max_speed);
}

void StabilityWatch::restart(const softbody::World& world) {
  *this = {};
  record(world, softbody::measure_bodies(world));
}

void StabilityWatch::went_back(const softbody::World& world) {
  guard_.restart();
  good_frame_ = std::min(good_frame_, world.frame());
  alarm_.reset();
  to_be_good_ = 0;
  margin_ = {};
  StabilityHistory& h = history_;
  for (Ring* ring :
       {&h.kinetic, &h.elastic, &h.gas, &h.gravity, &h.total, &h.least_volume, &h.most_volume, &h.strain, &h.speed})
    ring->forget_from(world.frame());
  record(world, softbody::measure_bodies(world));
}

void StabilityWatch::keep_present(const softbody::World& world) {
  const bool past = !rewind_.snapshots().empty() && world.frame() <= rewind_.snapshots().back().frame;
  if (to_be_good_ == 0 && !past) rewind_.keep(world);
}

}  // namespace app
