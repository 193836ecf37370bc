#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include <glm/geometric.hpp>

#include "app/report/files.h"
#include "app/report/solver/results.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/shape_matching.h"
#include "softbody/forces/springs.h"
#include "softbody/model/body_model.h"

namespace app::report {
namespace {

using glm::dvec3;
using softbody::GasPressure, softbody::Material, softbody::MeshSource, softbody::World;

constexpr int frames = 480;
constexpr double frame_time = 1.0 / 240;

MeshSource sphere(int subdivisions) { return {.subdivisions = subdivisions}; }

/// Returns a rounded body with a waist, as if from a file, whose triangles are of uneven sizes and forms.
MeshSource waisted(int subdivisions) {
  softbody::Mesh mesh = softbody::icosphere(subdivisions, 0.5);
  for (dvec3& v : mesh.vertices) {
    v = 0.5 * glm::normalize(v + 0.15 * dvec3(std::sin(4 * v.y), std::sin(5 * v.z), std::sin(3 * v.x)));
    v *= dvec3(1, 0.8 - 0.3 * std::exp(-20 * v.x * v.x), 0.8);
  }
  softbody::connect_triangles(mesh);
  return source_of(std::move(mesh));
}

/// Returns a material with this frequency of shape matching, or without.
Material material(double shape_frequency) {
  Material m = ball_material(200, 0.05);
  m[GasPressure::inside] = 104'000;
  m[GasPressure::outside] = 101'325;
  m[softbody::ShapeMatching::frequency] = shape_frequency;
  return m;
}

struct Shape {
  const char* name;
  MeshSource (*mesh)(int subdivisions);
  int coarsest;            // subdivisions that show its form
  double shape_frequency;  // Hz
};
constexpr Shape shapes[]{{"Sphere, springs and gas", sphere, 2, 0},
                         {"Uneven mesh, springs and gas", waisted, 3, 0},
                         {"Uneven mesh, shape matching", waisted, 3, 3}};
constexpr int finest = 5;

double extent_y(const Particles& particles) {
  const auto [least, most] = std::ranges::minmax(particles, {}, [](const auto& p) { return p.position.y; });
  return most.position.y - least.position.y;
}

double sag(softbody::Scene scene) {
  const Particles free = particles_of(World(scene, {}), 0);
  double lowest = 0;
  for (const softbody::Particle& p : free) lowest = std::min(lowest, p.position.y);
  scene.gravity = {0, -9.81, 0};
  scene.solids = {{softbody::Ground{}}};
  scene.materials[0][Material::internal_damping] = 10;  // it is to come to rest
  scene.bodies[0].position.y = 0.01 - lowest;
  World world(std::move(scene), {.frame_time = frame_time});
  double height = 0;  // the mean of the last quarter
  for (int f = 0; f < frames; ++f) {
    world.step();
    if (f >= frames * 3 / 4) height += extent_y(particles_of(world, 0)) / (frames / 4);
  }
  return (extent_y(free) - height) / world.model(0).radius;
}

/// Returns the period (s) at which a signal, one value a frame, has most of its power.
double strongest_period(std::span<const double> signal) {
  double mean = 0, most = 0, best = 0;
  for (const double value : signal) mean += value / double(signal.size());
  const double seconds = frame_time * double(signal.size());
  for (double period = seconds / 3; period > 4 * frame_time; period *= 0.998) {
    double cosine = 0, sine = 0;
    for (std::size_t f = 0; f < signal.size(); ++f) {
      const double share = double(f) / double(signal.size());
      const double window = std::pow(std::sin(std::numbers::pi * share), 2),
                   angle = 2 * std::numbers::pi * share * seconds / period;
      cosine += window * (signal[f] - mean) * std::cos(angle);
      sine += window * (signal[f] - mean) * std::sin(angle);
    }
    if (const double power = cosine * cosine + sine * sine; power > most) most = power, best = period;
  }
  return best;
}

double period(const softbody::Scene& scene) {
  World world = start_world(scene, {.frame_time = frame_time}, changed_start(scene, [](softbody::Particle& p) {
                              p.position *= dvec3(1.03, 1 / std::sqrt(1.03), 1 / std::sqrt(1.03));
                            }));
  std::vector<double> length;
  for (int f = 0; f < frames; ++f) {
    world.step();
    double squares = 0;  // there is no force from outside: the middle stays at the origin
    for (const softbody::Particle& p : particles_of(world, 0)) squares += p.position.x * p.position.x;
    length.push_back(std::sqrt(squares / double(world.model(0).mesh.vertices.size())));
  }
  return strongest_period(length);
}

}  // namespace

std::vector<Stiffness> measure_stiffness(bool quick) {
  std::vector<Stiffness> bodies;
  for (const Shape& shape : shapes)
    for (int subdivisions = shape.coarsest; subdivisions <= (quick ? shape.coarsest + 1 : finest); ++subdivisions) {
      say(shape.name, double(subdivisions - shape.coarsest) / (finest + 1 - shape.coarsest));
      softbody::Scene scene = lone_scene(material(shape.shape_frequency));
      scene.bodies[0].mesh = shape.mesh(subdivisions);
      bodies.push_back({shape.name, scene.bodies[0].mesh.make().vertices.size(), sag(scene), period(scene)});
    }
  return bodies;
}

}  // namespace app::report
