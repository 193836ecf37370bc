// Cases in which a body moves as a whole, or two particles swing on a spring.

#include <array>
#include <cmath>

#include "app/report/theory/closed_forms.h"
#include "app/report/theory/results.h"
#include "softbody/contact/keys.h"
#include "softbody/forces/air_drag.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/shape_matching.h"
#include "softbody/forces/springs.h"

namespace app::report {
namespace {

using closed_form::g, closed_form::pi;
using softbody::Material, softbody::Scene, softbody::World;

/// Returns a scene with a coarse ball that falls.
Scene falling_ball(double speed) {
  Scene scene = lone_scene(ball_material(100, 0.5));
  scene.gravity = {0, -g, 0};
  scene.bodies[0].mesh.subdivisions = 1;
  scene.bodies[0].velocity = {0, speed, 0};
  return scene;
}

void free_fall(TheoryRun& run) {
  World world = run.begin(falling_ball(5));
  const double start = motion_of(world).centre.y;
  run.step(world, 120);
  const std::string_view by = run.took->key;
  const double late = run.took->order > 1 ? 0 : by == "explicit-euler" ? -run.substep : run.substep;
  const double theory = 5 * 2 - g * 2 * (2 + late) / 2;
  run.comparisons = {{.theory = theory, .measured = motion_of(world).centre.y - start, .bound = run.rounding()}};
}

void air(TheoryRun& run) {
  constexpr double drag = 2;  // kg/s, on 1 kg
  Scene scene = falling_ball(0);
  scene.materials[0][softbody::AirDrag::drag] = drag;
  World world = run.begin(scene);
  run.step(world, 30);
  const double theory = g / drag * (std::exp(-drag * 0.5) - 1);
  run.comparisons = {{.what = "after 0.5 s", .theory = theory, .measured = motion_of(world).velocity.y}};
  run.step(world, 450);
  run.comparisons.push_back(
      {.what = "after 8 s", .theory = -g / drag, .measured = motion_of(world).velocity.y, .bound = 1e-4});
}

constexpr double pulled = 0.1, omega = 20;  // m, 1/s

/// Lets two particles of half a kilogram each swing for 2 s on a spring of 100 N/m. Returns by how much it is longer.
Signal swinging_pair(TheoryRun& run, double damping_ratio) {
  softbody::Mesh pair;
  pair.vertices = {{-0.5, 0, 0}, {0.5, 0, 0}};
  pair.edges = {{0, 1}};
  pair.stated_for = 2;
  Material material;
  material.set(softbody::StructuralSprings::keys, {100, damping_ratio});
  material[softbody::ShapeMatching::frequency] = 0;
  Scene scene = lone_scene(material);
  scene.bodies[0].mesh = source_of(std::move(pair));
  World world = run.begin(scene, [](softbody::Particle& p) { p.position *= 1 + pulled; });
  return run.sample(world, 120, [](const collide::Frame& at) { return double(at.x[1]) - double(at.x[0]) - 1; });
}

void spring(TheoryRun& run) {
  const Signal swing = swinging_pair(run, 0);
  const auto compare = [&](const std::string& what, const auto& theory, std::optional<double> bound) {
    const std::size_t last = swing.t.size() - 1;
    double most = 0;
    for (std::size_t n = 0; n <= last; ++n) most = std::max(most, std::abs(swing.value[n] - theory(n)) / pulled);
    run.comparisons.push_back({what, theory(last), swing.value[last], most, bound});
  };
  compare("", [&](std::size_t n) { return pulled * std::cos(omega * swing.t[n]); }, {});
  const auto stepped = [&](std::size_t n) {
    return pulled * closed_form::stepped(run.took->key, omega * run.substep, double(n)).real();
  };
  if (closed_form::has_step(run.took->key)) compare("by its steps", stepped, run.rounding() / pulled);
}

void decrement(TheoryRun& run) {
  constexpr double zeta = 0.05;
  const Signal swing = swinging_pair(run, zeta);
  std::vector<double> tops;
  for (std::size_t n = 1; n + 1 < swing.t.size(); ++n) {
    const double before = swing.value[n - 1], here = swing.value[n], after = swing.value[n + 1];
    if (here > 0 && here >= before && here > after)  // the top of a parabola through the three
      tops.push_back(here + std::pow(after - before, 2) / 8 / (2 * here - before - after));
  }
  const double measured = tops.size() < 2 ? 0 : std::log(tops.front() / tops.back()) / double(tops.size() - 1);
  run.comparisons = {{.theory = 2 * pi * zeta / std::sqrt(1 - zeta * zeta), .measured = measured}};
}

/// Returns a scene with a sheet at this height (m) over ground. lean: the tangent of the slope, down which is x.
Scene sheet(double height, double friction, double restitution, double lean) {
  Scene scene = lone_scene(ball_material(10, 0.5));
  scene.bodies[0].mesh = {.kind = "grid", .columns = 4, .rows = 4, .width = 1, .depth = 1};
  scene.bodies[0].position.y = height;
  scene.materials[0][Material::thickness] = 0;
  scene.gravity = g / std::sqrt(1 + lean * lean) * glm::dvec3(lean, -1, 0);
  scene.solids = {{.shape = softbody::Ground{}, .friction = friction, .restitution = restitution}};
  return scene;
}

void bounce(TheoryRun& run) {
  const double e = std::array{0.5, 0.8, 1.0}[std::size_t(run.variant)];
  Scene scene = sheet(0.3, 0, e, 0);
  scene.gravity = glm::dvec3(0.0);
  scene.bodies[0].velocity = {0, -3, 0};
  World world = run.begin(scene);
  run.step(world, 60);
  run.comparisons = {{.theory = 3 * e, .measured = motion_of(world).velocity.y, .bound = 1e-4}};
}

void swap_speeds(TheoryRun& run) {
  Scene scene = lone_scene(ball_material(1'000, 0));
  scene.materials[0][softbody::contact::restitution] = 1;
  scene.bodies[0].mesh.subdivisions = run.variant + 1;
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[0].velocity.x = 3;
  scene.bodies[1].position.x = 1.5;
  scene.contact_surface = softbody::ContactSurface::surfaces;
  World world = run.begin(scene);
  run.step(world, 60);
  run.comparisons = {{.theory = 3, .measured = motion_of(world, 1).velocity.x, .bound = 0.01}};
}

constexpr double mu = 0.5;

void slope(TheoryRun& run) {
  double holds = 0.3, slides = 0.7;  // tangents
  while (slides - holds > 1e-3) {
    const double lean = (holds + slides) / 2;
    World world = run.begin(sheet(0, mu, 0, lean));
    run.step(world, 20);
    (motion_of(world).centre.x < 1e-6 ? holds : slides) = lean;
  }
  const double degrees = 180 / pi;
  run.comparisons = {{.what = "slides from, degrees",
                      .theory = degrees * std::atan(mu),
                      .measured = degrees * std::atan(slides),
                      .bound = 0.01}};
  World world = run.begin(sheet(0, mu, 0, 1));
  run.step(world, 60);
  run.comparisons.push_back({.what = "acceleration, m/s²",
                             .theory = g * (1 - mu) / std::sqrt(2.0),
                             .measured = motion_of(world).velocity.x,
                             .bound = run.rounding()});
}

void way_to_rest(TheoryRun& run) {
  Scene scene = sheet(0, mu, 0, 0);
  scene.bodies[0].velocity.x = 2;
  World world = run.begin(scene);
  run.step(world, 60);
  run.comparisons = {{.theory = 2 * 2 / (2 * mu * g), .measured = motion_of(world).centre.x}};
}

void rolling(TheoryRun& run) {
  constexpr double radius = 0.5, lean = 0.3, gap = 0.001;  // on gentler slopes faces hold it
  Scene scene = sheet(radius + gap, 1, 0, lean);
  scene.bodies[0].mesh = {.subdivisions = run.variant + 2, .radius = radius};
  Material& material = scene.materials[0] = ball_material(20'000, 0);
  material.set(softbody::GasPressure::keys, {106'325, 101'325});
  material[Material::thickness] = gap;
  World world = run.begin(scene);
  run.step(world, 120);
  const double moment = 2.0 / 3 * std::pow(radius / (radius + gap), 2);  // over m r^2
  const double theory = g * lean / std::sqrt(1 + lean * lean) / (1 + moment);
  run.comparisons = {{.theory = theory, .measured = motion_of(world).velocity.x / 2, .bound = 0.01}};
}

}  // namespace

std::vector<TheoryCase> motion_cases() {
  const std::vector<std::string> one{""};
  return {{"free-fall", "Free fall: height after 2 s, m", one, false, free_fall},
          {"air", "Fall through air: speed, m/s", one, false, air, 1},
          {"spring", "Mass on a spring for 2 s, m", one, false, spring},
          {"decrement", "Damped spring: logarithmic decrement", one, false, decrement},
          {"bounce", "Bounce of a flat sheet: speed, m/s", {"e = 0.5", "e = 0.8", "e = 1"}, false, bounce},
          {"swap", "Two equal balls: speed of the one that was hit, m/s", {"42 vertices", "162"}, true, swap_speeds},
          {"slope", "Slope with friction 0.5", one, false, slope},
          {"way-to-rest", "Way to rest by friction, m", one, false, way_to_rest, 1},
          {"rolling", "Rolling: acceleration, m/s²", {"162 vertices", "642", "2,562"}, true, rolling}};
}

}  // namespace app::report
