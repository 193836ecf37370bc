#include "app/report/solver/results.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "softbody/contact/keys.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/springs.h"
#include "softbody/model/body_model.h"

namespace app::report {

using softbody::BendSprings, softbody::GasPressure, softbody::Material, softbody::StructuralSprings;

namespace {

using glm::dvec3;

/// A ball that flies and turns. Its gas has a tenth more pressure than in balance, so that it pulsates.
SolverScene free_flight(double stiffness, const std::string& in_words) {
  SolverScene s{.key = "free-" + in_words, .name = "Free flight, " + in_words + " N/m"};
  s.scene = lone_scene(ball_material(stiffness, 0.02));
  s.start = changed_start(
      s.scene, [](softbody::Particle& p) { p.velocity = dvec3(1, 2, 0.5) + glm::cross(dvec3(0.5, 3, 1), p.position); });
  s.scene.materials[0][GasPressure::inside] *= 1.1;
  return s;
}

/// A ball falls from rest, a millimetre over the ground. The motion of a ball that hits it fast would be chaotic.
SolverScene on_the_ground() {
  SolverScene s{.key = "contact-1e3", .name = "On the ground, 1e3 N/m"};
  s.scene = lone_scene(ball_material(1e3, 0.02));
  const softbody::World world = world_of(s.scene);
  const softbody::Particle lowest = particles_of(world, 0)[0];  // an icosphere's extent is that of any corner
  s.scene.gravity = {0, -9.81, 0};
  s.scene.solids = {{softbody::Ground{}}};
  s.scene.bodies[0].position.y = glm::length(lowest.position) + world.model(0).material[Material::thickness] + 1e-3;
  return s;
}

SolverScene in_balance(double stiffness, const std::string& in_words) {
  SolverScene s{.key = "rest-" + in_words, .name = "In balance, " + in_words + " N/m", .at_rest = true};
  s.scene = lone_scene(ball_material(stiffness, 0.02));
  return s;
}

/// A sheet falls across a round bar.
SolverScene cloth() {
  SolverScene s{.key = "cloth", .name = "Cloth over a bar"};
  Material m;
  m.name = "cloth";
  m[Material::mass] = 0.5;
  m.set(StructuralSprings::keys, {200, 0.1});
  m.set(softbody::ShearSprings::keys, {60, 0.1});
  m.set(BendSprings::keys, {1, 0.1});
  m[softbody::contact::rolling_resistance] = 0;
  s.scene = lone_scene(m);
  s.scene.bodies[0].mesh = {.kind = "grid", .columns = 16, .rows = 16, .width = 1.2, .depth = 1.2};
  s.scene.gravity = {0, -9.81, 0};
  const softbody::SolidCapsule bar{.from = {-100, -0.24, 0.1}, .to = {100, -0.24, 0.1}, .radius = 0.2};
  s.scene.solids = {{.shape = bar, .friction = 0.3}};
  return s;
}

/// The rubber of the shipped scenes, without what the reference does not model. Nearly all of its stiffness is its gas.
Material rubber() {
  Material m;
  m.name = "rubber";
  m.set(StructuralSprings::keys, {200, 0.1});
  m.set(BendSprings::keys, {50, 0.1});
  m[GasPressure::inside] = 113'000;
  m[GasPressure::outside] = 101'325;
  m[softbody::contact::rolling_resistance] = 0;
  return m;
}

/// A rubber ball whose particles `start` changes.
SolverScene deformed(std::string key, std::string name, const std::function<void(softbody::Particle&)>& start) {
  SolverScene s{.key = std::move(key), .name = std::move(name), .scene = lone_scene(rubber())};
  s.start = changed_start(s.scene, start);
  return s;
}

/// It turns once a second across the axis along which it is stretched.
SolverScene stretched(std::string key, std::string name, double across) {
  return deformed(std::move(key), std::move(name), [=](softbody::Particle& p) {
    p.position *= dvec3(1.2, across, across);
    p.velocity = glm::cross(dvec3(0, 2 * std::numbers::pi, 0), p.position);
  });
}

/// Three balls fall onto the ground, and a fourth onto them.
SolverScene four_balls() {
  SolverScene s{.key = "four-balls", .name = "Four balls on a floor", .of_centres = true};
  s.scene = lone_scene(rubber());
  const double radius = world_of(s.scene).model(0).radius;
  s.promised = 0.01 / radius;  // a centimetre
  s.scene.gravity = {0, -9.81, 0};
  s.scene.solids = {{softbody::Ground{}}};
  const double apart = 2 * radius + 0.1, height = radius + 0.1, up = apart * std::sqrt(2.0 / 3);
  const double across = apart / std::sqrt(3.0);  // from the middle of three
  s.scene.bodies.resize(4, s.scene.bodies[0]);
  for (int i = 0; i < 3; ++i) {
    const double angle = i * 2 * std::numbers::pi / 3;
    s.scene.bodies[std::size_t(i)].position = {across * std::cos(angle), height, across * std::sin(angle)};
  }
  s.scene.bodies[3].position = {0, height + up, 0};
  return s;
}

}  // namespace

std::vector<SolverScene> solver_scenes() {
  return {free_flight(1e3, "1e3"),
          free_flight(1e6, "1e6"),
          on_the_ground(),
          in_balance(1e3, "1e3"),
          in_balance(1e6, "1e6"),
          cloth(),
          deformed("inflated", "Inflated by 10 %", [](softbody::Particle& p) { p.position *= 1.1; }),
          stretched("stretched", "Stretched by 20 %, spinning", 1 / std::sqrt(1.2)),
          stretched("swollen", "Stretched by 20 % and swollen, spinning", 1),
          four_balls()};
}

}  // namespace app::report
