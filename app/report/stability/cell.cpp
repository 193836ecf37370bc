#include "app/report/stability/results.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "app/report/solid_passages.h"
#include "app/report/sums.h"
#include "collide/surface/box_tree.h"
#include "softbody/world/energy_watch.h"

namespace app::report {
namespace {

using glm::dvec3;
using softbody::BodyId;
using softbody::World;

/// A run, frame by frame.
class Run {
 public:
  Run(const StabilityStart& start) : start_(start), above_balance_(start.above_balance) {}

  World make(double frame_time, const softbody::Integrator& integrator, const std::vector<Particles>& particles) {
    World world =
        start_world(start_.scene, {.frame_time = frame_time, .integrator = with_steps(integrator, 1)}, particles);
    if (frame_ == 0) {
      passages_.observe(world);
      bodies_ = world.bodies().count();
      available_ = softbody::measure(world).energy;
    }
    energy_.restart();
    energy_.look(world, softbody::measure_bodies(world));
    booked_ = softbody::ledger(world).total();
    return world;
  }

  void step(World& world) {
    const std::vector<softbody::BodySource>& sources = start_.scene.bodies;  // in the order in which they join
    while (bodies_ < sources.size() && sources[bodies_].appear <= world.frame())
      above_balance_ += start_.members[bodies_++].kinetic();
    world.step();
    ++frame_;
    time_ += world.frame_time();
    require_whole_frame(world);
    if (bodies_ == 0) return;  // there is no body to judge
    passages_.observe(world);
    count_excess(world);
    const softbody::Measures m = softbody::measure(world);
    const double scale = std::max(above_balance_, sum_of(present(), &StabilityStart::Member::weight));  // J
    reference::StabilitySample s{.time = time_,
                                 .frame = frame_,
                                 .finite = m.finite,
                                 .excess = excess_ / scale,
                                 .depth = m.deepest_penetration,
                                 .passed_through = passages_.count()};
    if (m.finite) add_reach(world, m, scale, s);
    figures_.add(s, start_.limits);
  }

  double time() const { return time_; }
  bool lost() const { return figures_.diverged(); }
  const reference::StabilityFigures& figures() const { return figures_; }

 private:
  void count_excess(const World& world) {
    available_ += softbody::ledger(world).total() - booked_;
    booked_ = softbody::ledger(world).total();
    const double excess = excess_ + energy_.look(world, softbody::measure_bodies(world))->gain;
    excess_ = excess < 0 ? 0 : excess;  // what is not a number stays
  }

  void add_reach(const World& world, const softbody::Measures& m, double scale, reference::StabilitySample& s) {
    assert(bodies_ > 0);
    // J, for all but gravity
    const double available = available_ + reference::stability_bounds.energy * scale - m.energies.gravity;
    const double min_energy = 1e-9 * scale;  // what has flown away has lost all to gravity
    const auto particle_mass = [](const StabilityStart::Member& of) { return of.model->particle_mass; };
    const double balance = sum_of(present(), &StabilityStart::Member::balance);             // J
    const double lightest = particle_mass(std::ranges::min(present(), {}, particle_mass));  // kg
    s.speed = m.max_speed / std::sqrt(2 * std::max(available - balance, min_energy) / lightest);
    for (BodyId b = 0; b < world.bodies().count(); ++b) {
      collide::surface::Box box;
      for (const dvec3& p : reference::state_of(world, b).x) box.add(p);
      const auto& [length, stiffness] = start_.members[b].chain;
      const double reach = length + std::sqrt(2 * std::max(available - m.energies.gas, min_energy) / stiffness);
      s.extent = std::max(s.extent, std::max({box.extent(0), box.extent(1), box.extent(2)}) / reach);
    }
  }

  std::span<const StabilityStart::Member> present() const { return std::span(start_.members).first(bodies_); }

  const StabilityStart& start_;
  reference::StabilityFigures figures_;
  double above_balance_;  // J, that the present bodies started or joined with
  BodyId bodies_ = 0;     // that are present
  SolidPassages passages_;
  softbody::EnergyWatch energy_;
  double booked_ = 0;     // J, by the end of the last frame
  double available_ = 0;  // J: energy at the start, and all work since
  double excess_ = 0;     // J, see StabilitySample
  int frame_ = 0;
  double time_ = 0;
};

}  // namespace

reference::StabilityFigures run_cell(const StabilityStart& start, const softbody::Integrator& integrator, double dt) {
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
    reference::StabilityFigures figures = run.figures();
    if (start.not_judged.empty() && !run.lost())
      figures.reference = deviation(world.model(0), reference::state_of(world, 0), start.reference);
    return figures;
  } catch (const softbody::SceneError& error) {
    return {.refused = error.what()};
  }
}

}  // namespace app::report
