// Cases of spheres of springs and gas.

#include <cmath>
#include <set>

#include <glm/geometric.hpp>

#include "app/report/theory/closed_forms.h"
#include "app/report/theory/results.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/springs.h"
#include "softbody/model/body_model.h"
#include "softbody/world/measures.h"

namespace app::report {
namespace {

using glm::dvec3;
using softbody::GasPressure, softbody::Material, softbody::Scene, softbody::World;

constexpr closed_form::ShellMode p2{2};
constexpr double radius = 0.5, stiffness = 300, ambient = 101'325;  // m, N/m, Pa

/// Returns a scene with a sphere of springs, that neither bends nor damps, and gas.
Scene sphere(int variant, double k, double inside, double outside) {
  Material material = ball_material(k, 0);
  material[softbody::BendSprings::stiffness] = 0;
  material.set(GasPressure::keys, {inside, outside});
  Scene scene = lone_scene(material);
  scene.bodies[0].mesh = {.subdivisions = variant + 2, .radius = radius};
  return scene;
}

constexpr double of_swings = 0.03;  // bound of the errors of small swings: the mesh is not the theory's

/// Compares the frequency (Hz) near that of theory at which a signal has most of its power.
void compare(TheoryRun& run, const Signal& signal, double theory) {
  double sum = 0, best = theory;
  for (const double value : signal.value) sum += value / double(signal.value.size());
  const auto power = [&](double frequency) {
    std::complex<double> part = 0;
    for (std::size_t n = 0; n < signal.t.size(); ++n) {
      const double window = std::pow(std::sin(closed_form::pi * signal.t[n] / signal.t.back()), 2);
      part += std::polar(window * 1.0, 2 * closed_form::pi * frequency * signal.t[n]) * (signal.value[n] - sum);
    }
    return std::norm(part);
  };
  for (double step = 0.1 * theory; step > 1e-4 * theory; step /= 3) {  // the best of 7, then of those beside it
    const double middle = best;
    double most = 0;
    for (int i = -3; i <= 3; ++i)
      if (const double f = middle + i * step, here = power(f); here > most) most = here, best = f;
  }
  run.comparisons = {{.theory = theory, .measured = best, .bound = of_swings}};
  if (!closed_form::has_step(run.took->key)) return;
  const double stepped = closed_form::stepped_frequency(run.took->key, theory, run.substep);
  run.comparisons.push_back({.what = "by its steps", .theory = stepped, .measured = best, .bound = of_swings});
}

void ellipsoid(TheoryRun& run) {
  const auto mode = [](const dvec3& at) {
    const dvec3 out = glm::normalize(at), pole(0, 1, 0);
    return (1.5 * out.y * out.y - 0.5) * out + p2.slide() * 3 * out.y * (pole - out.y * out);
  };
  World world = run.begin(sphere(run.variant, stiffness, ambient, ambient),
                          [&](softbody::Particle& p) { p.position += 1e-3 * radius * mode(p.position); });
  const std::vector<dvec3>& rest = world.model(0).start;
  const Signal signal = run.sample(world, 60, [&](const collide::Frame& at) {
    double sum = 0;
    for (std::size_t v = 0; v < rest.size(); ++v) sum += glm::dot(mode(rest[v]), dvec3(at.x[v], at.y[v], at.z[v]));
    return sum;
  });
  compare(run, signal, p2.frequency(stiffness, 1));
}

void breathing(TheoryRun& run) {
  World world = run.begin(sphere(run.variant, stiffness, 500, 0), [](softbody::Particle& p) { p.position *= 1.001; });
  const softbody::BodyModel& model = world.model(0);
  double R = 0;
  for (const dvec3& at : model.start) R += glm::length(at) / double(model.start.size());
  const double P = softbody::gas_of(model)->pressure(model.start_volume);
  const Signal signal = run.sample(world, 60, [](const collide::Frame& at) {
    double sum = 0;
    for (std::size_t v = 0; v < at.x.size(); ++v) sum += glm::length(dvec3(at.x[v], at.y[v], at.z[v]));
    return sum;
  });
  compare(run, signal, closed_form::breathing_frequency(stiffness, 1, R, P, P));
}

void pressed_flat(TheoryRun& run) {
  constexpr double weight = 60 * closed_form::g;
  Scene scene = sphere(run.variant, 1'000, ambient + 2'000, ambient);  // all in tension: what is stiffer dents
  scene.materials[0][softbody::StructuralSprings::damping_ratio] = 0.3;
  scene.materials[0][Material::mass] = weight / closed_form::g;
  scene.materials[0][Material::internal_damping] = 10;
  scene.gravity = {0, -closed_form::g, 0};
  scene.solids = {{.shape = softbody::Ground{}, .friction = 0}};
  scene.bodies[0].position.y = 1.05 * radius;
  World world = run.begin(scene);
  run.step(world, 150);
  const softbody::BodyModel& model = world.model(0);
  const collide::Frame at = world.positions();
  std::set<softbody::Index> touching;
  for (const softbody::SolidContactPoint& point : softbody::solid_contacts(world)) touching.insert(point.vertex);
  double area = 0, volume = 0;  // of a face a third is each corner's
  for (const softbody::Triangle& face : model.mesh.triangles) {
    const auto corner = [&](std::size_t i) { return dvec3(at.x[face[i]], at.y[face[i]], at.z[face[i]]); };
    const dvec3 normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    volume += glm::dot(corner(0), normal) / 6;
    for (const softbody::Index v : face) area += touching.contains(v) ? glm::length(normal) / 6 : 0;
  }
  const double lies = double(touching.size()) / double(model.mesh.vertices.size());  // this part carries itself
  const double over = softbody::gas_of(model)->pressure(volume) - ambient;
  run.comparisons = {{.theory = weight * (1 - lies), .measured = over * area, .bound = 0.01}};
}

}  // namespace

std::vector<TheoryCase> shell_cases() {
  const std::vector<std::string> meshes{"162 vertices", "642", "2,562"};
  return {{"ellipsoid", "Ellipsoidal swing of a sphere, Hz", meshes, true, ellipsoid},
          {"breathing", "Breathing of a sphere, Hz", meshes, true, breathing},
          {"pressed-flat", "Pressed flat: weight that the gas carries, N", meshes, true, pressed_flat}};
}

}  // namespace app::report
