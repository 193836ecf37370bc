#include "tests/softbody/helpers.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace softbody::test {

Material spring_ball() {
  Material m;
  m.name = "springs";
  m[contact::rolling_resistance] = 0;
  m[Material::thickness] = 0;
  return m;
}

Material gas_ball() {
  Material m = spring_ball();
  m.name = "gas";
  m.set(StructuralSprings::keys, {200, 0.1});
  m.set(BendSprings::keys, {50, 0.1});
  m[GasPressure::inside] = 113000;
  m[GasPressure::outside] = 101325;
  return m;
}

Material gas_ball(double stiffness, double damping_ratio) {
  Material m = gas_ball();
  m.set(StructuralSprings::keys, {stiffness, damping_ratio});
  m.set(BendSprings::keys, {stiffness / 4, damping_ratio});
  m[GasPressure::inside] = 1.6 * stiffness;
  m[contact::rolling_resistance] = 0;
  return m;
}

Material damped(Material m) {
  m[Material::internal_damping] = 10;
  m[contact::rebound_speed] = 2;
  m[contact::rolling_resistance] = 0.3;
  return m;
}

Scene lone_body(const Material& material, const glm::dvec3& velocity) {
  Scene scene;
  scene.key = "test";
  scene.gravity = glm::dvec3(0.0);
  scene.collision.self_collision = false;
  scene.sleep.speed = 0;
  scene.materials = {material};
  add_body(scene, glm::dvec3(0.0), velocity);
  return scene;
}

void add_body(Scene& scene, const glm::dvec3& position, const glm::dvec3& velocity) {
  BodySource body;
  body.position = position;
  body.velocity = velocity;
  scene.bodies.push_back(body);
}

Scene sheet_on_ground(double friction, const glm::dvec3& gravity, const glm::dvec3& velocity) {
  Scene scene = lone_body(spring_ball(), velocity);
  MeshSource& mesh = scene.bodies.front().mesh;
  mesh.kind = "grid";
  mesh.columns = mesh.rows = 4;
  mesh.width = mesh.depth = 1;
  scene.gravity = gravity;
  set_solid(scene, {Ground{0}, friction});
  return scene;
}

Scene drop_scene() { return find_scene("drop", SBCOLLIDE_SCENES); }

void run(World& world, int frames) {
  for (int i = 0; i < frames; ++i) world.step();
}

std::vector<Particle> particles_of(const World& world, BodyId body) {
  std::vector<Particle> all;
  for (Index i = 0; i < world.model(body).mesh.vertices.size(); ++i) all.push_back(world.particle(body, i));
  return all;
}

void place(World& world, const glm::dvec3& scale, double rate) {
  std::vector<Particle> particles;
  for (const glm::dvec3& x : world.model(0).start) particles.push_back({scale * x, rate * x});
  world.set_particles(0, particles);
}

Motion motion(const World& world, BodyId body) {
  const BodyModel& model = world.model(body);
  const auto count = static_cast<Index>(model.mesh.vertices.size());
  Motion m{model.material[Material::mass], glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
  for (Index i = 0; i < count; ++i) {
    const Particle q = world.particle(body, i);
    m.centre += q.position / double(count);
    m.velocity += q.velocity / double(count);
  }
  for (Index i = 0; i < count; ++i) {
    const Particle q = world.particle(body, i);
    m.spin_momentum += model.particle_mass * glm::cross(q.position - m.centre, q.velocity - m.velocity);
  }
  return m;
}

Material every_force() {
  Material m;
  m.name = "every";
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (requires { F::keys; })
      for (const Key* key : F::keys) m[*key] = key->fallback > 0 ? key->fallback : 1;
  });
  return m;
}

glm::dvec3 angular_momentum(const World& world) {
  glm::dvec3 total(0.0);
  for (BodyId b = 0; b < world.bodies().count(); ++b) {
    const Motion m = motion(world, b);
    total += m.mass * glm::cross(m.centre, m.velocity) + m.spin_momentum;
  }
  return total;
}

std::vector<glm::dvec3> forces(const BodyModel& model, const std::vector<glm::dvec3>& x) {
  std::vector<glm::dvec3> f(x.size(), glm::dvec3(0.0));
  for_each_spring(model, [&](const Spring& s) {
    const glm::dvec3 d = x[s.j] - x[s.i];
    const double length = glm::length(d);
    const glm::dvec3 pull = s.stiffness * (1 - s.rest / length) * d;
    f[s.i] += pull;
    f[s.j] -= pull;
  });
  const Gas* gas = data<GasPressure>(model);
  if (!gas) return f;
  double v = 0;
  for (const auto& t : model.mesh.triangles) v += glm::dot(x[t[0]], glm::cross(x[t[1]], x[t[2]])) / 6;
  const double turn = 0.1 * gas->rest_volume;
  const double pressure = v >= turn ? gas->amount / v : gas->amount / turn - gas->amount / (turn * turn) * (v - turn);
  const double outside = std::abs(v) < turn ? gas->ambient * v / turn : std::copysign(gas->ambient, v);
  for (const auto& t : model.mesh.triangles) {
    const glm::dvec3 third = (pressure - outside) / 3 * 0.5 * glm::cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
    for (const Index corner : t) f[corner] += third;
  }
  return f;
}

// Not the library's distributions: those differ between standard libraries.
double uniform(std::mt19937& random, double lo, double hi) { return lo + (hi - lo) * double(random()) / 4294967296.0; }

// Braces: in a function's arguments each compiler would draw in an order of its own.
glm::dvec3 random_vector(std::mt19937& random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

void LaneField::randomise(std::mt19937& random, double size) {
  for (auto* component : {&x, &y, &z})
    for (float& value : *component) value = float(uniform(random, -size, size));
}

}  // namespace softbody::test
