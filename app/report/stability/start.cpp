#include "app/report/stability/results.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "softbody/forces/springs.h"
#include "softbody/world/body_model_set.h"
#include "softbody/world/measures.h"

namespace app::report {
namespace {

using glm::dvec3;
using softbody::BodyId;
using softbody::World;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Returns how many springs at most join any two particles: twice as many as join one particle and the farthest.
/// Returns nothing if springs do not join all particles.
std::optional<int> longest_chain(const softbody::BodyModel& model) {
  std::vector<std::vector<softbody::Index>> next(model.mesh.vertices.size());
  for (const softbody::Spring& s : softbody::springs<softbody::StructuralSprings>(model)) {
    next[s.i].push_back(s.j);
    next[s.j].push_back(s.i);
  }
  std::vector<int> distance(next.size(), -1);
  std::vector<softbody::Index> reached{0};  // from the nearest to the farthest
  distance[0] = 0;
  for (std::size_t k = 0; k < reached.size(); ++k)
    for (const softbody::Index j : next[reached[k]])
      if (distance[j] < 0) {
        distance[j] = distance[reached[k]] + 1;
        reached.push_back(j);
      }
  return reached.size() < next.size() ? std::nullopt : std::optional(2 * distance[reached.back()]);
}

StabilityStart::SpringChain spring_chain_of(const softbody::BodyModel& model) {
  const auto chain = longest_chain(model);
  if (!chain) return {infinite, infinite};
  double longest = 0, softest = infinite;
  for (const softbody::Spring& s : softbody::springs<softbody::StructuralSprings>(model)) {
    longest = std::max(longest, s.rest);
    softest = std::min(softest, s.stiffness);
  }
  return {*chain * longest, softest / *chain};
}

/// True if shape and volume agree.
bool alike(const reference::ReferenceBody& body, const reference::BodyState& a, const reference::BodyState& b) {
  constexpr double close = 1e-3;  // R; of the volume. A tenth of what solvers are allowed
  const reference::ReferenceDeviation apart = deviation(body.model(), a, b);
  return apart.shape <= close && apart.volume <= close;
}

}  // namespace

reference::ReferenceDeviation deviation(const softbody::BodyModel& model, const reference::BodyState& state,
                                        const reference::BodyState& reference) {
  const std::vector<softbody::Triangle>& faces = model.mesh.triangles;
  reference::ReferenceDeviation r{
      .shape = reference::shape_distance(state.x, reference.x) / model.radius,
      .rest = std::max(0.0, reference::deformation_speed(state) - reference::deformation_speed(reference))};
  if (model.mesh.closed)
    r.volume = std::abs(reference::volume_of(state.x, faces) / reference::volume_of(reference.x, faces) - 1);
  return r;
}

StabilityStart prepare(const StabilityScene& from, double seconds) {
  const World world = start_world(from.scene, {.integrator = one_step()}, from.start);
  StabilityStart s{.scene = from.scene, .particles = all_particles(world), .first_frame = from.first_frame};
  std::ranges::stable_sort(s.scene.bodies, {}, &softbody::BodySource::appear);
  for (const softbody::BodySource& source : s.scene.bodies) {
    const auto model = softbody::shared_body_model(source.mesh, s.scene.materials[std::size_t(source.material)]);
    s.members.push_back({model, spring_chain_of(*model), glm::dot(source.velocity, source.velocity)});
  }
  assert(!s.members.empty());
  const softbody::Measures measures = softbody::measure(world);
  s.above_balance = measures.energy - measures.energies.gravity;
  for (BodyId b = 0; b < s.particles.size(); ++b) s.above_balance -= s.members[b].balance();
  if (!s.particles.empty()) s.balance_shape = world.model(0).start;
  s.limits = {.seconds = s.first_frame + seconds,
              .radius = std::ranges::min(s.members, {}, &StabilityStart::Member::radius).radius(),
              .begins_inside = measures.deepest_penetration > 0};
  // The bodies are where they start. So no cell has to find their balance again, unless some join later.
  if (s.particles.size() == from.scene.bodies.size())
    for (softbody::Material& m : s.scene.materials) m[softbody::Material::start_in_equilibrium] = false;
  return s;
}

void find_reference(StabilityStart& start, std::uint64_t steps) {
  World world = world_of(start.scene);
  const auto no = [&](const std::string& why) { start.not_judged = fmt::format("the reference {}", why); };
  if (const std::string missing = reference::ReferenceBody::unsupported_stage(world); !missing.empty())
    return no(fmt::format("does not model {}", missing));
  world.set_particles(0, start.particles[0]);
  const reference::ReferenceBody body(world.model(0), world.scene());
  const auto flown = [&](const reference::BodyState& from, double fraction, std::uint64_t max_steps) {
    return reference::integrate(body, from, fraction,
                                {.seconds = start.limits.seconds, .steps = max_steps, .settled_speed = 1e-4});
  };
  const auto settled = [&](const reference::Trajectory& f) {
    return reference::unsettled_speed(body, f.end) <= reference::stability_bounds.rest;
  };
  const reference::BodyState first = reference::state_of(world, 0);
  const reference::Trajectory flight = flown(first, 0.5, steps);
  if (!flight.complete) return no("would take too many steps");
  if (!std::isfinite(reference::deformation_speed(flight.end))) return no("does not stay finite");
  if (!settled(flight)) return no("has not settled by then");
  const bool free = world.scene().gravity == dvec3(0.0);
  if (free && reference::shape_distance(flight.end.x, start.balance_shape) >
                  reference::stability_bounds.shape * body.model().radius)
    return no("does not recover");
  reference::Trajectory finer = flown(first, 0.25, 2 * steps);
  if (!finer.complete || !alike(body, flight.end, finer.end)) return no("does not converge");
  // Solvers in single precision start with such a disturbance. A body that turns back from inside out, for example, may
  // then come to rest elsewhere.
  const reference::Trajectory beside = flown(reference::perturbed(first, 1e-7 * body.model().radius), 0.5, 2 * steps);
  if (!beside.complete || !settled(beside) || !alike(body, beside.end, finer.end))
    return no("comes to rest later or elsewhere after a disturbance by the last digits of a float");
  start.reference = std::move(finer.end);
}

}  // namespace app::report
