// Cases of long runs of free bodies.

#include <cmath>

#include <glm/geometric.hpp>

#include "app/report/theory/closed_forms.h"
#include "app/report/theory/results.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/shape_matching.h"
#include "softbody/world/measures.h"

namespace app::report {
namespace {

using glm::dvec3;
using softbody::Scene, softbody::World;

/// Returns a scene with a coarse ball that does not damp; its gas has the pressure outside.
Scene coarse_ball(double stiffness) {
  softbody::Material material = ball_material(stiffness, 0);
  material.set(softbody::GasPressure::keys, {101'325, 101'325});
  material[softbody::ShapeMatching::frequency] = 0;
  Scene scene = lone_scene(material);
  scene.bodies[0].mesh.subdivisions = 1;
  return scene;
}

void flips(TheoryRun& run) {
  const dvec3 spin(0.5, 15, 0.5);  // 1/s
  softbody::Mesh mesh = softbody::icosphere(1, 0.5);
  for (dvec3& v : mesh.vertices) v *= dvec3(0.6, 0.8, 1);
  softbody::connect_triangles(mesh);
  dvec3 moments(0.0), squares(0.0);
  for (const dvec3& v : mesh.vertices) squares += v * v / double(mesh.vertices.size());
  for (int i = 0; i < 3; ++i) moments[i] = squares[(i + 1) % 3] + squares[(i + 2) % 3];
  const auto top = std::size_t(std::ranges::max_element(mesh.vertices, {}, &dvec3::y) - mesh.vertices.begin());
  Scene scene = coarse_ball(2e4);
  scene.bodies[0].mesh = source_of(std::move(mesh));
  World world = run.begin(scene, [&](softbody::Particle& p) { p.velocity = glm::cross(spin, p.position); });
  const Signal along = run.sample(world, 360, [&](const collide::Frame& at) {
    return glm::dot(moments * spin, dvec3(at.x[top], at.y[top], at.z[top]));
  });
  std::vector<double> times;
  for (std::size_t n = 1; n < along.t.size(); ++n)
    if (const double a = along.value[n - 1], b = along.value[n]; (a > 0) != (b > 0))
      times.push_back(std::lerp(along.t[n - 1], along.t[n], a / (a - b)));
  const double theory = closed_form::flip_time({moments.z, moments.y, moments.x}, {spin.z, spin.y, spin.x});
  const double measured = times.size() < 2 ? 0 : (times.back() - times.front()) / double(times.size() - 1);
  run.comparisons = {{.theory = theory, .measured = measured, .bound = 0.01}};
}

/// Takes many steps, and compares energy (over that at rest), momentum and spin with those at the start.
void long_run(TheoryRun& run, const std::function<void(softbody::Particle&)>& change) {
  const Scene scene = coarse_ball(1'000);
  const double at_rest = softbody::measure(world_of(scene)).energy;
  World world = run.begin(scene, change);
  const auto energy = [&] {
    const double half = run.took->staggered ? run.substep : 0;
    return softbody::measure(world, 0).conserved(half) - at_rest;
  };
  const auto spin = [&] { return motion_of(world).momentum; };   // of 1 kg
  const double first = energy(), scale = std::max(first, 0.01);  // J
  const dvec3 spin_first = spin();
  double band = 0, last = 0;
  while (run.substeps_done < (run.quick ? 1e3 : run.by.implicit ? 1e4 : 1e5)) {
    run.step(world, 1);
    last = energy();
    band = std::max(band, std::abs(last - first));
  }
  const double momentum = glm::length(softbody::measure(world).momentum), size = glm::length(spin_first);
  run.comparisons = {
      {"energy at the end, J", first, last, (last - first) / scale, 0.01},
      {"energy, band, J", 0, band, band / scale, 0.01},
      {"momentum, kg m/s", 0, momentum, momentum, 1e-4},
      {"spin, kg m²/s", size, glm::length(spin()), glm::distance(spin(), spin_first) / std::max(size, 0.1), 1e-4}};
}

void rest(TheoryRun& run) { long_run(run, {}); }
void swing(TheoryRun& run) {
  long_run(run, [](softbody::Particle& p) { p.position *= dvec3(1.02, 0.99, 0.99); });
}
void spinning(TheoryRun& run) {
  long_run(run, [](softbody::Particle& p) { p.velocity = glm::cross(dvec3(0, 2, 0), p.position); });
}

}  // namespace

std::vector<TheoryCase> long_cases() {
  return {{"flips", "Spin about the middle axis: time between flips, s", {""}, false, flips},
          {"long-rest", "Long run at rest", {""}, false, rest},
          {"long-swing", "Long run, swinging", {""}, false, swing},
          {"long-spin", "Long run, spinning", {""}, false, spinning}};
}

}  // namespace app::report
