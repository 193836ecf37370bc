#pragma once
// Small worlds to try, their totals, and forces worked out a second time by plain loops in double.

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "softbody/contact/keys.h"
#include "softbody/forces/model_forces.h"
#include "softbody/mechanics/bound.h"
#include "softbody/mechanics/make_body_model.h"
#include "softbody/state/lanes.h"
#include "softbody/world/measures.h"
#include "tests/solids.h"
#include "tests/temporary_folder.h"

namespace softbody::test {

/// Springs alone, no gas: the mesh itself is the resting shape. It goes as near to solids as it can.
Material spring_ball();
/// Springs and gas in balance, without any of the frame's dampers.
Material gas_ball();
/// gas_ball() of another stiffness in N/m, to which its pressure is in proportion.
Material gas_ball(double stiffness, double damping_ratio = 0.1);
/// The material with the frame's dampers as the shipped scenes' rubber has them.
Material damped(Material material);
/// One icosphere of 162 particles and 0.5 m: no gravity, no solids, no self-collision, no sleep.
Scene lone_body(const Material& material, const glm::dvec3& velocity = glm::dvec3(0.0));
/// A second body of the same mesh and material.
void add_body(Scene& scene, const glm::dvec3& position, const glm::dvec3& velocity);
/// A flat sheet of 4 x 4 quads that lies in the plane y = 0 on ground of the same height.
Scene sheet_on_ground(double friction, const glm::dvec3& gravity, const glm::dvec3& velocity);
Scene drop_scene();
/// A material whose values of every force are not zero: 1 in the key's unit if it has no fallback above 0.
Material every_force();

void run(World& world, int frames);
std::vector<Particle> particles_of(const World& world, BodyId body = 0);
/// The first body in its starting shape about the origin, so many times as large along each axis, with velocities in
/// proportion, of rate 1/s.
void place(World& world, const glm::dvec3& scale, double rate = 0);

/// A body's rigid part.
struct Motion {
  double mass;
  glm::dvec3 centre, velocity;
  glm::dvec3 spin_momentum;  // angular momentum about the centre
};
Motion motion(const World& world, BodyId body);
glm::dvec3 angular_momentum(const World& world);  // about the world's origin
/// Returns the forces of springs and gas at rest, by plain loops.
std::vector<glm::dvec3> forces(const BodyModel& model, const std::vector<glm::dvec3>& x);

/// Returns the model with one force and no other.
template <class F>
BodyModel with_force(BodyModel model, const typename F::Data& data) {
  auto forces = std::make_shared<ModelForces>();
  forces->of<F>() = data;
  set_bounds(*forces, model.mesh.vertices.size());
  model.forces = std::move(forces);
  return model;
}
/// The same with the model's own data.
template <class F>
BodyModel only(const BodyModel& model) {
  return with_force<F>(model, *data<F>(model));
}

/// Returns the line that work() throws; "was taken" if it throws none.
template <class Error = SceneError>
std::string error_of(const auto& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "was taken";
}
/// Expects that work() throws a line with these words.
template <class Error = SceneError>
void expect_error(const std::string& words, const auto& work) {
  const std::string line = error_of<Error>(work);
  EXPECT_NE(line.find(words), std::string::npos) << line;
}

double uniform(std::mt19937& random, double lo, double hi);
/// Components from -size to size, drawn in their order.
glm::dvec3 random_vector(std::mt19937& random, double size);

using namespace tests;

/// Three components over `particles` particles, one value a lane.
struct LaneField {
  explicit LaneField(std::size_t particles) : x(particles * lanes), y(x), z(x) {}
  LaneArray<float> x, y, z;
  Field<float> field() { return {x.data(), y.data(), z.data()}; }
  Field<const float> field() const { return {x.data(), y.data(), z.data()}; }
  glm::dvec3 at(std::size_t particle, int lane) const {
    const std::size_t s = particle * lanes + std::size_t(lane);
    return {x[s], y[s], z[s]};
  }
  void set(std::size_t particle, int lane, const glm::dvec3& value) {
    const std::size_t s = particle * lanes + std::size_t(lane);
    x[s] = float(value.x), y[s] = float(value.y), z[s] = float(value.z);
  }
  void randomise(std::mt19937& random, double size);
  bool operator==(const LaneField&) const = default;
};

}  // namespace softbody::test
