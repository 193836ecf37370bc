#include "app/report/solver/scenes.h"

#include <glm/geometric.hpp>
#include "app/report/steps.h"
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
  Material calm = ball_material(stiffness, 0.02);
  s.scene = lone_scene(calm);
  Particles& start = s.start.emplace_back(particles_of(softbody::World(s.scene, {.integrator = one_step()}), 0));
  for (softbody::Particle& p : start) p.velocity = dvec3(1, 2, 0.5) + glm::cross(dvec3(0.5, 3, 1), p.position);
  s.scene.materials[0][GasPressure::inside] *= 1.1;
  return s;
}

/// A ball falls from rest, a millimetre over the ground. The motion of a ball that hits it fast would be chaotic.
SolverScene on_the_ground() {
  SolverScene s{.key = "contact-1e3", .name = "On the ground, 1e3 N/m"};
  s.scene = lone_scene(ball_material(1e3, 0.02));
  const softbody::World world(s.scene, {.integrator = one_step()});
  const softbody::Particle lowest = particles_of(world, 0)[0];  // an icosphere's extent is that of any corner
  s.scene.gravity = {0, -9.81, 0};
  s.scene.ground = softbody::Ground{};
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
  s.scene.capsules.push_back({.from = {-100, -0.24, 0.1}, .to = {100, -0.24, 0.1}, .radius = 0.2, .friction = 0.3});
  return s;
}

}  // namespace

Material ball_material(double stiffness, double damping_ratio) {
  Material m;
  m.name = "ball";
  m.set(StructuralSprings::keys, {stiffness, damping_ratio});
  m.set(BendSprings::keys, {stiffness / 4, damping_ratio});
  m[GasPressure::inside] = 1.6 * stiffness;
  m[softbody::contact::rolling_resistance] = 0;
  return m;
}

softbody::Scene lone_scene(const Material& material) {
  softbody::Scene scene;
  scene.gravity = dvec3(0.0);
  scene.collision.self_collision = false;
  scene.sleep.speed = 0;
  scene.materials = {material};
  softbody::BodySource& body = scene.bodies.emplace_back();
  body.position = dvec3(0.0);
  return scene;
}

Particles particles_of(const softbody::World& world, softbody::BodyId body) {
  Particles list;
  for (softbody::Index i = 0; i < world.model(body).mesh.vertices.size(); ++i) list.push_back(world.particle(body, i));
  return list;
}

std::vector<SolverScene> solver_scenes() {
  return {free_flight(1e3, "1e3"), free_flight(1e6, "1e6"), on_the_ground(),
          in_balance(1e3, "1e3"),  in_balance(1e6, "1e6"),  cloth()};
}

}  // namespace app::report
