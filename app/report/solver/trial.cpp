#include "app/report/solver/results.h"

#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "softbody/model/body_model.h"
#include "softbody/world/measures.h"

namespace app::report {
namespace {

using softbody::BodyId;
using softbody::World;

const softbody::Integrator& rk4() { return *softbody::find_integrator("rk4"); }

constexpr double spacing = 4;  // m, between copies

/// Returns a world of `copies` of the scene side by side.
World make_world(const SolverScene& of, const softbody::Integrator& integrator, int substeps, int copies) {
  softbody::Scene scene = of.scene;
  scene.bodies.clear();
  std::vector<Particles> starts;
  for (int c = 0; c < copies; ++c) {
    for (softbody::BodySource body : of.scene.bodies) {
      body.position.x += c * spacing;
      scene.bodies.push_back(body);
    }
    for (Particles start : of.start) {
      for (softbody::Particle& p : start) p.position.x += c * spacing;
      starts.push_back(std::move(start));
    }
  }
  const softbody::IntegratorChoice steps = with_steps(integrator, substeps);
  return start_world(std::move(scene), {.frame_time = solver_frame_time, .integrator = steps}, starts);
}

/// Runs the world to the end. It ends with the first frame that is not finite.
Outcome advance(World world) {
  Outcome o;
  int substeps = 0;
  for (int frame = 0; frame < solver_frames && o.finite; ++frame) {
    const double start = thread_seconds();
    const double wall_ms = time_ms([&] { world.step(); });
    o.timed += {.wall = 1e-3 * wall_ms, .processor = thread_seconds() - start};
    o.finite = softbody::measure(world).finite;
    substeps += world.last_step().substeps;
  }
  o.taken = double(substeps) / world.frame();
  for (BodyId b = 0; b < world.bodies().count(); ++b) o.bodies.push_back(reference::state_of(world, b));
  o.energy = softbody::measure(world).energy;
  return o;
}

/// Returns the difference (R) of two states: the largest of a body's centre, or the RMS over all bodies.
double difference(const std::vector<reference::BodyState>& a, const std::vector<reference::BodyState>& b,
                  const World& world, bool of_centres) {
  double square_sum = 0, largest = 0;
  for (BodyId id = 0; id < b.size(); ++id) {
    const double apart =
        of_centres ? glm::distance(reference::rigid_motion(a[id]).centre, reference::rigid_motion(b[id]).centre)
                   : reference::rms_distance(a[id].x, b[id].x);
    const double e = apart / world.model(id).radius;
    largest = std::max(largest, e);
    square_sum += e * e / double(b.size());
  }
  return of_centres ? largest : std::sqrt(square_sum);
}

/// Returns the outcome of the world's own rk4 in floats, for scenes that ReferenceBody does not model.
SolverReference world_reference(const SolverScene& scene, double bound, std::uint64_t steps) {
  const World world = make_world(scene, rk4(), 1, 1);
  World trial = make_world(scene, rk4(), 1, 1);
  trial.step();
  int substeps = trial.last_step().needed;
  SolverReference t{};
  Outcome best = run_solver(scene, rk4(), substeps, 1);
  while (!t.converged && std::uint64_t(2 * substeps) * solver_frames <= steps) {
    substeps *= 2;
    Outcome finer = run_solver(scene, rk4(), substeps, 1);
    t.change = difference(best.bodies, finer.bodies, world, scene.of_centres);
    t.converged = t.change <= bound;
    best = std::move(finer);
  }
  SolverScene shifted = scene;
  constexpr double shift = 1e-5;  // m: floats would lose a smaller one
  for (BodyId b = 0; b < world.bodies().count(); ++b) {
    if (scene.start.empty()) shifted.start.push_back(particles_of(world, b));
    for (std::size_t i = 0; i < shifted.start[b].size(); i += 2) shifted.start[b][i].position.x += shift;
  }
  t.growth = difference(run_solver(shifted, rk4(), substeps, 1).bodies, best.bodies, world, false) *
             world.model(0).radius / (shift / std::sqrt(2));
  t.bodies = std::move(best.bodies);
  t.energy = best.energy;
  t.step = solver_frame_time / substeps;
  t.what = "the world's rk4 in floats";
  return t;
}

SolverReference body_reference(const World& world, double bound, std::uint64_t steps) {
  const reference::ReferenceBody body(world.model(0), world.scene());
  SolverReference t{
      find_reference(body, reference::state_of(world, 0), bound, {.seconds = solver_seconds, .steps = steps})};
  t.energy = body.energy(t.end);
  t.bodies = {t.end};
  t.what = "RK4 in double, a program of its own";
  return t;
}

/// Returns the scale (J) of a body's error in energy: the larger of its energy above balance and m g R.
double energy_scale(const World& world, BodyId id) {
  const softbody::BodyModel& model = world.model(id);
  const softbody::Energy now = softbody::measure(world, id).energy;
  const double above_balance = now.total() - now.gravity - model.start_energy.total();
  return std::max(above_balance, model.material[softbody::Material::mass] * 9.81 * model.radius);
}

/// Returns the distance as a share of the length of `b`.
double relative(const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) / glm::length(b); }

}  // namespace

Outcome run_solver(const SolverScene& scene, const softbody::Integrator& integrator, int substeps, int copies) {
  return advance(make_world(scene, integrator, substeps, copies));
}

WorkPoint judge(const SolverCase& of, const Outcome& o) {
  const SolverScene& scene = of.scene;
  const SolverReference& reference = of.reference;
  WorkPoint p;
  p.taken = o.taken;
  const World world = world_of(scene.scene);
  p.blew_up = !o.finite;
  if (p.blew_up) return p;
  p.error = difference(o.bodies, reference.bodies, world, scene.of_centres);
  p.blew_up = p.error > 10;  // R
  p.energy = std::abs(o.energy - reference.energy) / reference.energy_scale;
  double square_sum = 0, volume = 0;
  bool closed = false;
  for (BodyId b = 0; b < o.bodies.size(); ++b) {
    const auto& mesh = world.model(b).mesh;
    const double speed = reference::deformation_speed(o.bodies[b]);
    square_sum += speed * speed / double(o.bodies.size());
    if (!mesh.closed) continue;
    closed = true;
    const double expected = reference::volume_of(reference.bodies[b].x, mesh.triangles);
    volume = std::max(volume, std::abs(reference::volume_of(o.bodies[b].x, mesh.triangles) / expected - 1));
  }
  p.speed = std::sqrt(square_sum);
  if (closed) p.volume = volume;
  const reference::RigidMotion actual = reference::rigid_motion(o.bodies[0]),
                               expected = reference::rigid_motion(reference.bodies[0]);
  const bool alone = o.bodies.size() == 1 && scene.scene.gravity == glm::dvec3(0.0);
  if (alone && glm::length(expected.velocity) > 1e-6) p.linear = relative(actual.velocity, expected.velocity);
  if (alone && glm::length(expected.momentum) > 1e-6) p.angular = relative(actual.momentum, expected.momentum);
  return p;
}

bool WorkCurve::reaches(double error) const {
  return std::ranges::any_of(points, [&](const WorkPoint& p) { return !p.blew_up && p.error <= error; });
}

const WorkPoint& SolverCase::own(std::string_view integrator) const {
  const auto curve = std::ranges::find(curves, integrator, [](const WorkCurve& c) { return c.integrator->key; });
  assert(curve != curves.end() && curve->own);
  return *curve->own;
}

double SolverCase::allowed() const {
  const WorkPoint& rival = own("semi-implicit-euler");
  return rival.blew_up ? scene.promised : std::max(scene.promised, 2 * rival.error);
}

std::optional<double> SolverCase::order(const WorkCurve& curve, double bound) const {
  if (scene.at_rest) return std::nullopt;
  std::vector<double> row, longest;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const WorkPoint &a = curve.points[i - 1], &b = curve.points[i];
    const bool falls = !a.blew_up && !b.blew_up && a.error <= max_order_error && b.error < clear_fall * a.error;
    if (!falls) row.clear();
    if (falls) row.push_back(std::log2(a.error / b.error) / std::log2(double(b.substeps) / a.substeps));
    if (row.size() >= longest.size()) longest = row;
  }
  if (longest.size() < (curve.reaches(uncertainty(bound)) ? 1 : 2)) return std::nullopt;
  std::ranges::sort(longest);
  const std::size_t n = longest.size();
  return (longest[(n - 1) / 2] + longest[n / 2]) / 2;
}

SolverCase begin_case(const SolverScene& scene, double bound, std::uint64_t steps) {
  const World world = make_world(scene, rk4(), 1, 1);
  const bool modelled = reference::ReferenceBody::unsupported_stage(world).empty();
  SolverCase c{scene, modelled ? body_reference(world, bound, steps) : world_reference(scene, bound, steps)};
  for (BodyId b = 0; b < world.bodies().count(); ++b) c.reference.energy_scale += energy_scale(world, b);
  for (const softbody::Integrator& integrator : softbody::integrators()) {
    WorkCurve& curve = c.curves.emplace_back(WorkCurve{&integrator});
    if (std::ranges::find(own_step_integrators, integrator.key) != own_step_integrators.end())
      curve.own = judge(c, run_solver(scene, integrator, 0, 1));
  }
  return c;
}

}  // namespace app::report
