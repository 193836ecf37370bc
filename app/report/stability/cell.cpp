#include "app/report/stability/cell.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/reference/shield_account.h"
#include "app/report/solid_passages.h"
#include "app/report/steps.h"
#include "softbody/measures.h"
#include "softbody/snapshot.h"

namespace app {
namespace {

using glm::dvec3;
using softbody::BodyId;
using softbody::World;

double gas_energy(const softbody::Prototype& p, const Particles& particles) {
  if (!p.has_gas) return 0;
  std::vector<dvec3> x;
  for (const softbody::Particle& q : particles) x.push_back(q.position);
  return p.gas.energy(volume_of(x, p.mesh.triangles));
}

/// Returns the longest side (m) of the particles' box.
double extent_of(const Particles& particles) {
  assert(!particles.empty());
  dvec3 lo = particles[0].position, hi = lo;
  for (const softbody::Particle& p : particles) lo = glm::min(lo, p.position), hi = glm::max(hi, p.position);
  return std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z});
}

/// A run, frame by frame.
class Run {
 public:
  Run(const StabilityStart& start) : start_(start), judge_(start.limits), above_balance_(start.above_balance) {}

  World make(double frame_time, const softbody::Integrator& integrator, const std::vector<Particles>& particles) {
    World world(
        start_.scene,
        {.frame_time = frame_time, .integrator = std::string(integrator.key), .substeps = steps_for(integrator, 1)});
    for (BodyId b = 0; b < particles.size(); ++b) world.set_particles(b, particles[b]);
    if (frame_ == 0) {
      passages_.observe(world);
      shields_.join(world.shield_energies(), 0);
      while (bodies_ < world.bodies().count()) add_body();
    }
    return world;
  }

  void step(World& world) {
    join(world);
    const double depth_before = softbody::measure(world).deepest_penetration;
    world.step();
    ++frame_;
    time_ += world.frame_time();
    require_whole_frame(world);
    if (bodies_ == 0) return;  // there is no body to judge
    passages_.observe(world);
    shields_.frame(world.last_shield_energies(), world.shield_energies());
    const softbody::Measures m = softbody::measure(world);
    StabilitySample s{.time = time_,
                      .frame = frame_,
                      .finite = m.finite,
                      .energy = m.energy + shields_.stored(),
                      .scale = std::max(above_balance_, weight_),
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
    add_work(world, depth_before);
    s.work = work_;
    const StabilityLimits& limits = start_.limits;
    double available = limits.energy + work_ + stability_bounds.energy * s.scale;  // for all but gravity and gas
    double gas = 0;
    std::vector<double> extents;
    for (BodyId b = 0; b < world.bodies().count(); ++b) {
      const Particles particles = particles_of(world, b);
      available -= height_energy(world, particles, b);
      gas += gas_energy(world.prototype(b), particles);
      extents.push_back(extent_of(particles));
    }
    const double min_energy = 1e-9 * s.scale;  // what has flown away has lost all to gravity
    s.speed_reach = std::sqrt(2 * std::max(available - balance_, min_energy) / lightest_);
    s.extent_reach = 1;
    for (std::size_t b = 0; b < extents.size(); ++b) {
      const auto& [length, stiffness] = start_.members[b].chain;
      const double reach = length + std::sqrt(2 * std::max(available - gas, min_energy) / stiffness);
      if (extents[b] / reach > s.extent / s.extent_reach) s.extent = extents[b], s.extent_reach = reach;
    }
  }

  /// Counts the next body as present and returns it.
  const StabilityStart::Member& add_body() {
    const StabilityStart::Member& member = start_.members[bodies_++];
    balance_ += member.balance;
    weight_ += member.weight();
    lightest_ = std::min(lightest_, member.particle_mass);
    return member;
  }

  /// Credits bodies that join in the coming step with their energy, which may be negative, and with what their pairs
  /// hold where they join; not with what their first frame makes of it.
  void join(World& world) {
    const std::vector<softbody::BodySource>& sources = start_.scene.bodies;  // in this order
    const BodyId first = bodies_;
    while (bodies_ < sources.size() && sources[bodies_].appear <= world.frame()) {
      const StabilityStart::Member& member = add_body();
      work_ += member.energy();
      above_balance_ += member.kinetic;
    }
    if (bodies_ == first) return;
    const auto joiners = std::span(sources).subspan(first, bodies_ - first);
    work_ += shields_.join(shield_energies_with(world, joiners), world.bodies().vertex_count());
  }

  /// Solids push out what is inside them with up to 1 m/s. So their work is at most that times the impulse.
  void add_work(const World& world, double depth_before) {
    constexpr double push_out = 1;  // m/s
    if (frame_ > 1 && depth_before <= 0) came_out_ = true;
    if (start_.limits.begins_inside && !came_out_)
      for (BodyId b = 0; b < world.bodies().count(); ++b)
        work_ += push_out * glm::length(world.dynamics().solid_impulse(b));
  }

  const StabilityStart& start_;
  StabilityJudge judge_;
  double above_balance_;                                       // J, that the present bodies started or joined with
  BodyId bodies_ = 0;                                          // that are present
  double balance_ = 0;                                         // J, their springs and gas in balance
  double weight_ = 0;                                          // J, their m g R
  double lightest_ = std::numeric_limits<double>::infinity();  // kg, of their particles
  SolidPassages passages_;
  ShieldAccount shields_;
  int frame_ = 0;
  double time_ = 0, work_ = 0;
  bool came_out_ = false;
};

AgainstReference compare(const World& world, const StabilityStart& start) {
  const softbody::Prototype& p = world.prototype(0);
  const BodyState end = state_of(world, 0);
  AgainstReference r{.shape = shape_distance(end.x, start.reference.x) / p.radius,
                     .rest = std::max(0.0, internal_speed(end) - internal_speed(start.reference))};
  if (p.mesh.closed)
    r.volume = std::abs(volume_of(end.x, p.mesh.triangles) / volume_of(start.reference.x, p.mesh.triangles) - 1);
  return r;
}

}  // namespace

std::vector<softbody::PairEnergy> shield_energies_with(softbody::World& world,
                                                       std::span<const softbody::BodySource> joiners) {
  if (!world.plan().has(softbody::Stage::contact_response)) return {};
  const softbody::Snapshot before = world.snapshot();
  for (const softbody::BodySource& joiner : joiners) world.add(joiner);
  std::vector<softbody::PairEnergy> pairs = world.shield_energies();
  world.restore(before);
  return pairs;
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
    if (start.not_judged.empty() && !run.lost()) figures.reference = compare(world, start);
    return figures;
  } catch (const softbody::SceneError& error) {
    return {.refused = error.what()};
  }
}

}  // namespace app
