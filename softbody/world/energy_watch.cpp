#include "softbody/world/energy_watch.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "softbody/model/body_model.h"

namespace softbody {
namespace {

using Measured = std::vector<BodyMeasures>;

/// Returns the energy (J) that moves and deforms the bodies.
double active_energy(const World& world, const Measured& bodies) {
  double sum = 0;
  Energy rest;
  const BodyModel* last = nullptr;
  for (BodyId id = 0; id < bodies.size(); ++id) {
    const BodyModel& p = world.model(id);
    if (&p != std::exchange(last, &p)) rest = starting_energy(p);
    const Energy& e = bodies[id].energy;
    sum += e.kinetic + std::abs(e.elastic - rest.elastic) + std::abs(e.gas - rest.gas);
  }
  return sum;
}

double conserved(const Measured& bodies, double staggered) {
  double sum = 0;
  for (const BodyMeasures& b : bodies) sum += b.conserved(staggered);
  return sum;
}

double deformation(const Measured& bodies) {
  double sum = 0;
  for (const BodyMeasures& b : bodies) sum += b.energy.deformation();
  return sum;
}

double rounding_energy(const World& world) {
  constexpr double speed = 1e-3;  // m/s: where nothing moves, rounding moves bodies far more slowly
  double mass = 0;
  for (BodyId id = 0; id < world.bodies().count(); ++id) mass += world.model(id).material[Material::mass];
  return mass / 2 * speed * speed;
}

}  // namespace

std::optional<EnergyChange> EnergyWatch::look(const World& world, const Measured& bodies) {
  assert(bodies.size() == world.bodies().count());
  Look now{{}, bodies, booked_work(world), active_energy(world, bodies)};
  for (BodyId id = 0; id < bodies.size(); ++id) now.numbers.push_back(world.body(id).number);
  const std::optional<Look> before = std::exchange(last_, std::move(now));
  if (!before) return {};
  const double h = staggered_substep(world);
  EnergyChange change{.gain = conserved(bodies, h) - conserved(before->bodies, h) - (last_->booked - before->booked),
                      .active = std::max(before->active, last_->active),
                      .rounding = rounding_energy(world),
                      .body = 0};
  if (world.last_step().integrator->projects)
    change.gain -= std::max(0.0, deformation(bodies) - deformation(before->bodies));
  double largest = -std::numeric_limits<double>::infinity();
  for (BodyId id = 0; id < bodies.size(); ++id) {
    const auto old = std::ranges::lower_bound(before->numbers, last_->numbers[id]);
    if (old == before->numbers.end() || *old != last_->numbers[id]) continue;
    const double gain =
        bodies[id].conserved(h) - before->bodies[std::size_t(old - before->numbers.begin())].conserved(h);
    if (gain > largest) largest = gain, change.body = id;
  }
  return change;
}

}  // namespace softbody
