// Compares the reports' reference with closed forms, and with the world's own solver at small steps.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "app/reference/reference_trajectory.h"
#include "app/report/worlds.h"
#include "softbody/forces/model_forces.h"
#include "softbody/mechanics/bound.h"
#include "tests/solids.h"

namespace app::test {
namespace THIS_FILE {

using glm::dvec3;

softbody::Scene lone_ball(double stiffness, double damping_ratio) {
  softbody::Material m = report::ball_material(stiffness, damping_ratio);
  m[softbody::GasPressure::inside] = 0.5 * stiffness;
  return report::lone_scene(m);
}

/// Two particles, joined by a spring of 1 m.
struct Pair {
  Pair(double stiffness, double damping) {
    model.mesh.vertices = {{0, 0, 0}, {1, 0, 0}};
    auto forces = std::make_shared<softbody::ModelForces>();
    forces->of<softbody::StructuralSprings>() = {{{0, 1, 1.0, stiffness, damping}}, {}};
    set_bounds(*forces, 2);
    model.forces = forces;
    model.particle_mass = 0.5;
    model.radius = 0.5;
    model.material[softbody::Material::thickness] = 0.005;
    scene.gravity = {};
  }
  softbody::BodyModel model;
  softbody::Scene scene;
  reference::BodyState stretched{{{0, 0, 0}, {1.1, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}};
  reference::ReferenceBody body{model, scene};
};

TEST(ReferenceBody, AgreesWithTheClosedFormOfADampedSpring) {
  const Pair pair(100, 2);
  const double reduced = 0.25, rate = 2 / (2 * reduced), omega = std::sqrt(100 / reduced - rate * rate);
  const double t = 0.37;
  const double stretch = 0.1 * std::exp(-rate * t) * (std::cos(omega * t) + rate / omega * std::sin(omega * t));
  const reference::Trajectory trajectory = reference::integrate(pair.body, pair.stretched, 0.01, {.seconds = t});
  EXPECT_NEAR(trajectory.end.x[1].x - trajectory.end.x[0].x, 1 + stretch, 1e-9);
}

TEST(ReferenceBody, ConvergesWithOrderFour) {
  const Pair pair(100, 0);
  const double t = 0.5, exact = 1 + 0.1 * std::cos(20 * t);
  const auto error = [&](double fraction) {
    const reference::BodyState end = reference::integrate(pair.body, pair.stretched, fraction, {.seconds = t}).end;
    return std::abs(end.x[1].x - end.x[0].x - exact);
  };
  EXPECT_NEAR(std::log2(error(0.1) / error(0.05)), 4, 0.3);
}

TEST(ReferenceBody, FollowsAParabolaInFreeFall) {
  softbody::Scene scene = lone_ball(1e3, 0.02);
  scene.gravity = {0, -9.81, 0};
  scene.bodies[0].velocity = {3, 4, 5};
  const softbody::World world(scene, {});
  const reference::ReferenceBody body(world.model(0), scene);
  const reference::BodyState end = reference::integrate(body, reference::state_of(world, 0), 1, {.seconds = 0.5}).end;
  const reference::RigidMotion m = reference::rigid_motion(end);
  EXPECT_LT(glm::distance(m.centre, 0.5 * dvec3(3, 4, 5) + 0.125 * dvec3(0, -9.81, 0)), 1e-7);
  EXPECT_LT(reference::deformation_speed(end), 1e-4) << "it started in equilibrium";
}

TEST(ReferenceBody, HasForcesThatAreTheGradientOfTheEnergy) {
  softbody::Scene scene = lone_ball(1e3, 0);
  scene.materials[0][softbody::GasPressure::outside] = 300;
  const softbody::World world(scene, {});
  const reference::ReferenceBody body(world.model(0), scene);
  for (const double scale : {1.1, 0.3, -0.5}) {  // large, below 0.1 V0, inside out
    reference::BodyState s = reference::state_of(world, 0);
    for (dvec3& p : s.x) p *= scale;
    const std::vector<dvec3> a = body.accelerations(s);
    for (const std::size_t i : {0, 17, 99})
      for (int k = 0; k < 3; ++k) {
        const double d = 1e-6;
        reference::BodyState up = s, down = s;
        up.x[i][k] += d, down.x[i][k] -= d;
        const double force = -(body.energy(up) - body.energy(down)) / (2 * d);
        EXPECT_NEAR(world.model(0).particle_mass * a[i][k], force, 1e-4 * std::abs(force) + 1e-5) << scale;
      }
  }
}

TEST(ReferenceBody, StopsOnTheGroundAndSlowsByFriction) {
  Pair pair(100, 0);
  tests::set_solid(pair.scene, {.shape = softbody::Ground{.height = 0}, .friction = 0.5});
  pair.scene.gravity = {0, -10, 0};
  pair.model.material[softbody::Material::thickness] = 0;
  const reference::BodyState sliding{{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, 0, 1}}};
  const reference::BodyState end = reference::integrate(pair.body, sliding, 0.02, {.seconds = 0.1}).end;
  EXPECT_NEAR(end.v[0].z, 0.5, 1e-6) << "0.1 s at 5 m/s^2";
  EXPECT_NEAR(end.x[0].y, 0, 1e-12);
}

TEST(ReferenceBody, AgreesWithTheWorldInContact) {
  softbody::Scene scene = lone_ball(1e3, 0.02);
  scene.gravity = {0, -9.81, 0};
  tests::set_solid(scene, {softbody::Ground{}});
  scene.bodies[0].position = {0, 0.55, 0};
  softbody::World world(scene, {.integrator = {"rk4", 512}});
  EXPECT_EQ(reference::ReferenceBody::unsupported_stage(world), "");
  const reference::ReferenceBody body(world.model(0), world.scene());
  const reference::Reference r =
      find_reference(body, reference::state_of(world, 0), 1e-5, {.seconds = 0.25, .steps = 20'000});
  EXPECT_LT(r.change, 1e-3);
  for (int frame = 0; frame < 15; ++frame) world.step();
  EXPECT_LT(reference::rms_distance(reference::state_of(world, 0).x, r.end.x) / world.model(0).radius, 1e-3);
}

TEST(ReferenceBody, KeepsItsAccuracyAKilometreFromTheOrigin) {
  softbody::Scene scene = lone_ball(1e8, 0.02);
  const softbody::World world(scene, {.integrator = {.substeps = 1}});
  const reference::ReferenceBody body(world.model(0), scene);
  reference::BodyState s{world.model(0).start, std::vector<dvec3>(162, dvec3(0.0))};
  for (dvec3& p : s.x) p += 1000.0;
  EXPECT_LT(reference::deformation_speed(reference::integrate(body, s, 0.5, {.seconds = 1e-3}).end), 1e-3);
}

TEST(ReferenceBody, NamesAStageThatItDoesNotModel) {
  softbody::Scene scene = lone_ball(1e3, 0.02);
  scene.materials[0][softbody::Material::internal_damping] = 1;
  EXPECT_EQ(reference::ReferenceBody::unsupported_stage(softbody::World(scene, {})), "internal-damping");
  scene.bodies.push_back(scene.bodies[0]);
  EXPECT_EQ(reference::ReferenceBody::unsupported_stage(softbody::World(scene, {})), "several bodies");
}

TEST(Integrate, EndsWhenSettledOrAtTheStepLimit) {
  const Pair pair(100, 5);
  EXPECT_TRUE(reference::integrate(pair.body, pair.stretched, 0.5, {.seconds = 1e9, .settled_speed = 1e-6}).complete);
  const reference::Trajectory cut =
      reference::integrate(pair.body, pair.stretched, 0.5, {.seconds = 1e9, .steps = 100});
  EXPECT_FALSE(cut.complete);
  EXPECT_EQ(cut.steps, 100u);
}

TEST(UnsettledSpeed, CountsAllMotionUnlessTheBodyIsFree) {
  reference::BodyState falling{{{0, 0, 0}, {1, 0, 0}}, {{0, -1, 0}, {0, -1, 0}}};
  Pair pair(100, 5);
  EXPECT_LT(reference::unsettled_speed(pair.body, falling), 1e-12) << "without gravity it may keep flying";
  pair.scene.gravity = {0, -9.81, 0};
  EXPECT_DOUBLE_EQ(reference::unsettled_speed({pair.model, pair.scene}, falling), 1);
  pair.scene.gravity = {};
  tests::set_solid(pair.scene, {softbody::Ground{}});
  EXPECT_DOUBLE_EQ(reference::unsettled_speed({pair.model, pair.scene}, falling), 1) << "it touches the ground";
}

TEST(BodyShape, SeparatesRigidMotionFromDeformation) {
  reference::BodyState s{{{1, 0, 0}, {-1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, {}};
  const dvec3 spin(0.3, -1, 0.5), velocity(1, 2, 3);
  std::vector<dvec3> turned;
  for (const dvec3& p : s.x) {
    s.v.push_back(velocity + glm::cross(spin, p));
    turned.emplace_back(-p.y + 5, p.x + 1e3, p.z);
  }
  EXPECT_LT(reference::shape_distance(s.x, turned), 1e-9);
  EXPECT_LT(glm::distance(reference::rigid_motion(s).spin, spin), 1e-9);
  EXPECT_LT(reference::deformation_speed(s), 1e-9);
  turned[0].x += 1;
  EXPECT_GT(reference::shape_distance(s.x, turned), 0.1);
  s.v[0].y += 1;
  EXPECT_GT(reference::deformation_speed(s), 0.1);
}

}  // namespace THIS_FILE
}  // namespace app::test
