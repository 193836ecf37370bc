#include "app/report/stability/results.h"

#include <glm/geometric.hpp>

#include "app/files/inputs.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/shape_matching.h"
#include "softbody/forces/springs.h"

namespace app::report {

using softbody::BendSprings, softbody::GasPressure, softbody::ShearSprings, softbody::StructuralSprings;

namespace {

using glm::dvec3;

constexpr double damping_ratio = 0.1, radius = 0.5;  // m
constexpr double g = 9.81;                           // m/s^2

/// Returns a ball at rest, without gravity, solids and self-collision.
StabilityScene lone(double k) { return {.scene = lone_scene(ball_material(k, damping_ratio))}; }

/// Returns the ball with each particle at place(where it rests).
template <class Place>
StabilityScene placed(double k, Place place) {
  StabilityScene s = lone(k);
  s.start = changed_start(s.scene, [&](softbody::Particle& p) { p.position = place(p.position); });
  return s;
}

/// Returns the ball with its axes times these factors.
StabilityScene stretched_by(double k, const dvec3& factors) {
  return placed(k, [&](const dvec3& p) { return p * factors; });
}
StabilityScene random_vertices(double k) {
  std::mt19937 random(1);
  return placed(k, [&](const dvec3&) { return radius * reference::random_vector(random); });
}

/// Returns a ball whose middle is `height` over the ground.
StabilityScene over_ground(double k, double height) {
  StabilityScene s = lone(k);
  s.scene.gravity = {0, -g, 0};
  s.scene.solids = {{softbody::Ground{}}};
  s.scene.bodies[0].position = {0, height, 0};
  return s;
}

/// Returns the radius of the ball with its gas; the mesh itself is smaller.
double inflated(double k) { return glm::length(particles_of(world_of(lone(k).scene), 0)[0].position); }

StabilityScene on_the_ground(double k) { return over_ground(k, inflated(k) + 0.006); }

StabilityScene long_frame(double k) {
  StabilityScene s = over_ground(k, 1.5);
  s.first_frame = 0.5;
  return s;
}

/// Solids push out with at most 1 m/s. From deeper, the ball would not be out within the frames that the criteria
/// allow.
StabilityScene inside_solid(double k) { return over_ground(k, inflated(k) - 0.15 * radius); }

StabilityScene mass_ratio(double k) {
  StabilityScene s = on_the_ground(k);
  s.scene.materials.push_back(s.scene.materials[0]);
  s.scene.materials[1][softbody::Material::mass] = 1000;
  s.scene.bodies.push_back(s.scene.bodies[0]);
  s.scene.bodies[1].material = 1;
  s.scene.bodies[1].position.y += 2.5 * inflated(k);
  return s;
}

StabilityScene stiffness_ratio(double k) {
  StabilityScene s = lone(k);
  s.scene.materials.push_back(ball_material(1e-6 * k, damping_ratio));
  s.scene.bodies.push_back(s.scene.bodies[0]);
  s.scene.bodies[1].material = 1;
  s.scene.bodies[1].position.y = 3 * inflated(k);
  s.scene.bodies[1].velocity.y = -1;
  return s;
}

StabilityScene tiny_mass(double k) {
  StabilityScene s = stretched_by(k, {1, 0.5, 1});
  s.scene.materials[0][softbody::Material::mass] = 1e-6;
  return s;
}

/// A ball flies at a plate, which is thinner than the ball's way in a frame and too wide to miss.
StabilityScene impact(double k, double speed) {
  StabilityScene s = lone(k);
  s.scene.solids = {{softbody::SolidBox{.centre = {0, -0.05, 0}, .half_size = {1e3, 0.05, 1e3}}}};
  s.scene.bodies[0].position = {0, inflated(k) + 0.3, 0};
  s.scene.bodies[0].velocity = {0, -speed, 0};
  return s;
}

/// Returns a ball that starts in balance with another gas pressure than its own.
StabilityScene pressure_times(double k, double factor) {
  StabilityScene s = stretched_by(k, dvec3(1));
  s.scene.materials[0][GasPressure::inside] *= factor;
  return s;
}

/// Returns a ball, flattened to a half, of a mesh in which `damage` has moved vertices of triangle 0.
template <class Damage>
StabilityScene damaged_mesh(double k, Damage damage) {
  StabilityScene s = lone(k);
  softbody::Mesh mesh = softbody::icosphere(2, radius);
  const auto [a, b, c] = mesh.triangles[0];
  damage(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  s.scene.bodies[0].mesh = source_of(std::move(mesh));
  s.scene.materials[0][softbody::ShapeMatching::frequency] = 0;
  s.start = changed_start(s.scene, [](softbody::Particle& p) { p.position.y *= 0.5; });
  return s;
}

StabilityScene pile(double k) {
  StabilityScene s{.scene = softbody::find_scene("D", files::scene_folder())};
  for (softbody::Material& m : s.scene.materials) {
    const softbody::Material stiff = ball_material(k, damping_ratio);
    for (const softbody::Key* key : {&StructuralSprings::stiffness, &StructuralSprings::damping_ratio,
                                     &BendSprings::stiffness, &BendSprings::damping_ratio, &GasPressure::inside})
      m[*key] = stiff[*key];
    m[GasPressure::outside] = 0;
  }
  return s;
}

}  // namespace

const std::vector<StabilityCase>& stability_cases() {
  static const std::vector<StabilityCase> all{
      {"rest", "At rest", lone},
      {"stretched", "Stretched 10 times", [](double k) { return stretched_by(k, dvec3(10, 1, 1)); }},
      {"flattened", "Flattened", [](double k) { return stretched_by(k, dvec3(1, 0, 1)); }},
      {"collapsed", "Collapsed to a point",
       [](double k) { return placed(k, [](const dvec3&) { return dvec3(0.0); }); }},
      {"nearly-collapsed", "Collapsed to a thousandth", [](double k) { return stretched_by(k, dvec3(1e-3)); }},
      {"random", "Random vertices", random_vertices},
      {"inside-out", "Inside out", [](double k) { return stretched_by(k, dvec3(-1)); }},
      {"mass-ratio", "1000 kg on 1 kg", mass_ratio},
      {"stiffness-ratio", "A body hits one 1e6 times as stiff", stiffness_ratio},
      {"tiny-mass", "Mass 1e-6 kg, half flat", tiny_mass},
      {"impact-10", "At a thin plate with 10 m/s", [](double k) { return impact(k, 10); }},
      {"impact-100", "At a thin plate with 100 m/s", [](double k) { return impact(k, 100); }},
      {"impact-1000", "At a thin plate with 1000 m/s", [](double k) { return impact(k, 1000); }},
      {"long-frame", "A frame of 0.5 s, falling", long_frame},
      {"overpressure", "Pressure x 100", [](double k) { return pressure_times(k, 100); }},
      {"pressure-lost", "Pressure lost", [](double k) { return pressure_times(k, 0); }},
      {"inside-solid", "Begins 0.15 R in the ground", inside_solid},
      {"on-the-ground", "On the ground", on_the_ground},
      {"duplicates", "Duplicate vertices, half flat",
       [](double k) { return damaged_mesh(k, [](dvec3& a, dvec3& b, dvec3&) { b = a; }); }},
      {"degenerate", "Degenerate faces, half flat",
       [](double k) { return damaged_mesh(k, [](dvec3& a, dvec3& b, dvec3& c) { c = 0.5 * (a + b); }); }},
      {"far", "1 km from the origin, half flat",
       [](double k) { return placed(k, [](const dvec3& p) { return 1000.0 + p * dvec3(1, 0.5, 1); }); }},
      {"pile", "A pile of 47", pile}};
  return all;
}

StabilityScene scaled(softbody::Scene scene, double factor) {
  for (softbody::Material& m : scene.materials)
    for (const softbody::Key* key : {&StructuralSprings::stiffness, &BendSprings::stiffness, &ShearSprings::stiffness,
                                     &GasPressure::inside, &GasPressure::outside})
      m[*key] *= factor;
  return {.scene = std::move(scene)};
}

}  // namespace app::report
