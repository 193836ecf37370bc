#include "app/stability_cell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/solid_passages.h"
#include "softbody/measures.h"

namespace app {
namespace {

using glm::dvec3;
using softbody::BodyId;
using softbody::World;

/// J, springs and gas of a prototype in balance.
double balance_of(const softbody::Prototype& p) {
  softbody::Scene nowhere;
  nowhere.gravity = dvec3(0.0);
  return ReferenceBody(p, nowhere).energy({p.start, std::vector<dvec3>(p.start.size(), dvec3(0.0))});
}

/// Any two particles are joined by a chain of so many springs at most: twice those from one particle to the farthest.
/// None if some cannot be reached.
std::optional<int> longest_chain(const softbody::Prototype& p) {
  std::vector<std::vector<softbody::Index>> next(p.mesh.vertices.size());
  for (const softbody::Spring& s : p.structural) next[s.i].push_back(s.j), next[s.j].push_back(s.i);
  std::vector<int> far(next.size(), -1);
  std::queue<softbody::Index> open;
  far[0] = 0, open.push(0);
  while (!open.empty()) {
    const softbody::Index i = open.front();
    open.pop();
    for (const softbody::Index j : next[i])
      if (far[j] < 0) far[j] = far[i] + 1, open.push(j);
  }
  const auto [least, most] = std::ranges::minmax(far);
  return least < 0 ? std::nullopt : std::optional(2 * most);
}

/// J, of gravity on one body, 0 at the origin.
double height_energy(const World& world, const Particles& particles, BodyId body) {
  double energy = 0;
  for (const softbody::Particle& p : particles)
    energy -= world.prototype(body).particle_mass * glm::dot(world.scene().gravity, p.position);
  return energy;
}

double gas_energy(const softbody::Prototype& p, const Particles& particles) {
  if (!p.has_gas) return 0;
  std::vector<dvec3> x;
  for (const softbody::Particle& q : particles) x.push_back(q.position);
  return p.gas.energy(volume_of(x, p.mesh.triangles));
}

/// m, the longest side of the particles' box.
double extent_of(const Particles& particles) {
  dvec3 lo = particles[0].position, hi = lo;
  for (const softbody::Particle& p : particles) lo = glm::min(lo, p.position), hi = glm::max(hi, p.position);
  return std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z});
}

/// A run, frame by frame.
class Run {
 public:
  Run(const StabilityStart& start) : start_(start), judge_(start.limits) {}

  World make(double frame_time, const softbody::Integrator& integrator, const std::vector<Particles>& particles) {
    World world(
        start_.scene,
        {.frame_time = frame_time, .integrator = std::string(integrator.key), .substeps = steps_of(integrator)});
    for (BodyId b = 0; b < particles.size(); ++b) world.set_particles(b, particles[b]);
    if (frame_ == 0) {
      passages_.look(world);
      energy_ = softbody::measure(world).energy;
      bodies_ = world.bodies().count();
    }
    return world;
  }

  void step(World& world) {
    const double depth_before = softbody::measure(world).deepest_penetration;
    world.step();
    ++frame_;
    time_ += world.frame_time();
    passages_.look(world);
    const softbody::Measures m = softbody::measure(world);
    StabilitySample s{.time = time_,
                      .frame = frame_,
                      .finite = m.finite,
                      .energy = m.energy,
                      .speed = m.max_speed,
                      .depth = m.deepest_penetration,
                      .through = passages_.count()};
    if (m.finite) add_reach(world, s, depth_before);
    judge_.add(s);
  }

  double time() const { return time_; }
  bool lost() const { return judge_.lost(); }
  const StabilityFigures& figures() const { return judge_.figures(); }

 private:
  void add_reach(const World& world, StabilitySample& s, double depth_before) {
    add_work(world, s, depth_before);
    s.work = work_;
    const StabilityLimits& limits = start_.limits;
    double available = limits.energy + work_ + stability_bounds.energy * limits.scale;  // for all but gravity and gas
    double gas = 0, lightest = std::numeric_limits<double>::infinity();
    std::vector<double> extents;
    for (BodyId b = 0; b < world.bodies().count(); ++b) {
      const Particles particles = particles_of(world, b);
      available -= height_energy(world, particles, b);
      gas += gas_energy(world.prototype(b), particles);
      lightest = std::min(lightest, world.prototype(b).particle_mass);
      extents.push_back(extent_of(particles));
    }
    const double least = 1e-9 * limits.scale;  // what has flown away has lost all to gravity
    s.speed_reach = std::sqrt(2 * std::max(available - start_.balance, least) / lightest);
    s.extent_reach = 1;
    for (std::size_t b = 0; b < std::min(extents.size(), start_.reach.size()); ++b) {
      const double reach = start_.reach[b] + std::sqrt(2 * std::max(available - gas, least) / start_.softest[b]);
      if (extents[b] / reach > s.extent / s.extent_reach) s.extent = extents[b], s.extent_reach = reach;
    }
  }

  /// Solids push out what is inside them with up to 1 m/s: no more than that times the impulse. And bodies that join
  /// bring their energy along.
  void add_work(const World& world, const StabilitySample& s, double depth_before) {
    constexpr double push_out = 1;  // m/s
    if (frame_ > 1 && depth_before <= 0) came_out_ = true;
    if (start_.limits.begins_inside && !came_out_)
      for (BodyId b = 0; b < world.bodies().count(); ++b)
        work_ += push_out * glm::length(world.dynamics().solid_impulse(b));
    if (world.bodies().count() != bodies_) work_ += std::max(0.0, s.energy - energy_);
    bodies_ = world.bodies().count();
    energy_ = s.energy;
  }

  const StabilityStart& start_;
  StabilityJudge judge_;
  SolidPassages passages_;
  int frame_ = 0;
  double time_ = 0, work_ = 0, energy_ = 0;
  bool came_out_ = false;
  BodyId bodies_ = 0;
};

std::vector<Particles> all_particles(const World& world) {
  std::vector<Particles> list;
  for (BodyId b = 0; b < world.bodies().count(); ++b) list.push_back(particles_of(world, b));
  return list;
}

AgainstReference compare(const World& world, const StabilityStart& start) {
  const softbody::Prototype& p = world.prototype(0);
  const BodyState end = state_of(world, 0);
  AgainstReference r{.shape = shape_distance(end.x, start.truth.x) / p.radius, .rest = internal_speed(end)};
  if (p.mesh.closed)
    r.volume = std::abs(volume_of(end.x, p.mesh.triangles) / volume_of(start.truth.x, p.mesh.triangles) - 1);
  return r;
}

}  // namespace

std::optional<int> steps_of(const softbody::Integrator& integrator) {
  return integrator.key == "auto" ? std::nullopt : std::optional(1);
}

StabilityStart prepare(const StabilityScene& from, double seconds) {
  World world(from.scene, {.substeps = 1});
  for (BodyId b = 0; b < from.start.size(); ++b) world.set_particles(b, from.start[b]);
  StabilityStart s{.scene = from.scene, .particles = all_particles(world), .first_frame = from.first_frame};
  const bool all_there = s.particles.size() == from.scene.bodies.size();
  for (softbody::Material& m : s.scene.materials)
    if (all_there) m.start_in_equilibrium = false;
  const softbody::Measures m = softbody::measure(world);
  double height = 0, weight = 0, smallest = std::numeric_limits<double>::infinity();
  for (BodyId b = 0; b < s.particles.size(); ++b) {
    const softbody::Prototype& p = world.prototype(b);
    height += height_energy(world, s.particles[b], b);
    weight += p.material.mass * 9.81 * p.radius;
    smallest = std::min(smallest, p.radius);
    s.balance += balance_of(p);
    const auto chain = longest_chain(p);
    double longest = 0, softest = std::numeric_limits<double>::infinity();
    for (const softbody::Spring& spring : p.structural)
      longest = std::max(longest, spring.rest), softest = std::min(softest, spring.stiffness / chain.value_or(1));
    s.reach.push_back(chain ? *chain * longest : std::numeric_limits<double>::infinity());
    s.softest.push_back(softest);
  }
  if (!s.particles.empty()) s.balanced = world.prototype(0).start;
  s.limits = {.energy = m.energy,
              .scale = std::max(m.energy - height - s.balance, weight),
              .seconds = from.first_frame + seconds,
              .radius = smallest,
              .begins_inside = m.deepest_penetration > 0};
  return s;
}

void find_truth(StabilityStart& start, std::uint64_t steps) {
  constexpr double close = 1e-3;  // R, of volume: a tenth of what is asked of solvers
  World world(start.scene, {.substeps = 1});
  const auto no = [&](const std::string& why) { start.untold = why; };
  if (const std::string missing = ReferenceBody::missing(world); !missing.empty())
    return no("the reference does not model " + missing);
  world.set_particles(0, start.particles[0]);
  const ReferenceBody body(world.prototype(0), world.scene());
  const softbody::Prototype& p = world.prototype(0);
  const auto flown = [&](double fraction, std::uint64_t most) {
    return fly(body, state_of(world, 0), fraction,
               {.seconds = start.limits.seconds, .steps = most, .settled_speed = 1e-4});
  };
  Flight flight = flown(0.5, steps);
  if (!flight.complete) return no("the reference would take too many steps");
  const double speed = internal_speed(flight.end);
  if (!std::isfinite(speed)) return no("the reference does not stay finite");
  if (speed > stability_bounds.rest) return no("the reference has not settled by then");
  const bool free = world.scene().gravity == dvec3(0.0);
  if (free && shape_distance(flight.end.x, start.balanced) > stability_bounds.shape * p.radius)
    return no("the reference does not recover");
  Flight finer = flown(0.25, 2 * steps);
  const double shape = shape_distance(flight.end.x, finer.end.x) / p.radius;
  const double volume =
      p.mesh.closed ? volume_of(flight.end.x, p.mesh.triangles) / volume_of(finer.end.x, p.mesh.triangles) - 1 : 0;
  if (!finer.complete || !(shape <= close && std::abs(volume) <= close)) return no("the reference does not converge");
  start.truth = std::move(finer.end);
}

StabilityFigures run_cell(const StabilityStart& start, const softbody::Integrator& integrator, double dt) {
  try {
    Run run(start);
    std::vector<Particles> particles = start.particles;
    if (start.first_frame > 0) {
      World world = run.make(start.first_frame, integrator, particles);
      run.step(world);
      if (run.lost()) return run.figures();
      particles = all_particles(world);
    }
    World world = run.make(dt, integrator, particles);
    while (!run.lost() && run.time() < start.limits.seconds - dt / 2) run.step(world);
    StabilityFigures figures = run.figures();
    if (start.untold.empty() && !run.lost()) figures.reference = compare(world, start);
    return figures;
  } catch (const softbody::SceneError& error) {
    return {.refused = error.what()};
  }
}

}  // namespace app
