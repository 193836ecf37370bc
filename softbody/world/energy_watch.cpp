#include "softbody/world/energy_watch.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "softbody/model/body_model.h"

namespace softbody {
namespace {

using Measured = std::vector<BodyMeasures>;

/// Returns the energy (J) that moves and deforms the bodies.
double active_energy(const World& world, const Measured& bodies) {
  double sum = 0;
  for (BodyId id = 0; id < bodies.size(); ++id) {
    const StoredEnergy& rest = world.model(id).start_energy;
    const Energy& e = bodies[id].energy;
    sum += e.kinetic + std::abs(e.elastic - rest.elastic) + std::abs(e.gas - rest.gas);
  }
  return sum;
}

double sum(const std::vector<double>& list) { return std::accumulate(list.begin(), list.end(), 0.0); }

double rounding_energy(const World& world) {
  constexpr double speed = 1e-3;  // m/s: where nothing moves, rounding moves bodies far more slowly
  double mass = 0;
  for (BodyId id = 0; id < world.bodies().count(); ++id) mass += world.model(id).material[Material::mass];
  return mass / 2 * speed * speed;
}

}  // namespace

std::optional<EnergyChange> EnergyWatch::look(const World& world, const Measured& bodies) {
  assert(bodies.size() == world.bodies().count());
  const Integrator* integrator = world.last_step().integrator;  // none before the first step
  Look now{{}, {}, ledger(world).total(), active_energy(world, bodies), !integrator || integrator->conserves_energy};
  for (BodyId id = 0; id < bodies.size(); ++id) {
    now.numbers.push_back(world.body(id).number);
    now.energies.push_back(bodies[id].conserved(ledger(world).staggering));
  }
  const std::optional<Look> before = std::exchange(last_, now);
  if (!before) return {};
  EnergyChange change{.gain = sum(now.energies) - sum(before->energies) - (now.booked - before->booked),
                      .active = std::max(before->active, now.active),
                      .rounding = rounding_energy(world),
                      .body = 0,
                      .conserved = before->conserved && now.conserved};
  double largest = -std::numeric_limits<double>::infinity();
  for (BodyId id = 0; id < bodies.size(); ++id) {
    const auto old = std::ranges::lower_bound(before->numbers, now.numbers[id]);
    if (old == before->numbers.end() || *old != now.numbers[id]) continue;
    const double gain = now.energies[id] - before->energies[std::size_t(old - before->numbers.begin())];
    if (gain > largest) largest = gain, change.body = id;
  }
  return change;
}

}  // namespace softbody
