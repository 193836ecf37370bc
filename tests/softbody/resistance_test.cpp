// What acts once a frame on a body as a whole: internal damping, rolling resistance, rebound damping.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "softbody/integrate/plan.h"
#include "softbody/integrate/resistance.h"
#include "softbody/state/rigid_motion.h"
#include "tests/softbody/helpers.h"
#include "tests/support/world_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

/// Kinetic energy that is not the rigid motion's, in J.
double vibration(const World& world) {
  const Motion m = motion(world, 0);
  const double mass = world.model(0).particle_mass;
  glm::dmat3 inertia(0.0);
  double kinetic = 0;
  for (Index i = 0; i < 162; ++i) {
    const Particle q = world.particle(0, i);
    const glm::dvec3 r = q.position - m.centre;
    inertia += mass * (glm::dmat3(glm::dot(r, r)) - glm::outerProduct(r, r));
    kinetic += 0.5 * mass * glm::dot(q.velocity - m.velocity, q.velocity - m.velocity);
  }
  return kinetic - 0.5 * glm::dot(m.spin_momentum, glm::inverse(inertia) * m.spin_momentum);
}

/// After a frame that shook a body without dampers against a solid, the frames that follow in free flight.
Scene shaken(double internal_damping) {
  Material m = gas_ball();
  m[StructuralSprings::damping_ratio] = m[BendSprings::damping_ratio] = 0;
  m[Material::internal_damping] = internal_damping;
  Scene scene = lone_body(m, glm::dvec3(4, 0, 0));
  scene.bodies[0].position = {-2, 1.2, 0};
  set_solid(scene, {.shape = SolidSphere{.centre = glm::dvec3(0.0), .radius = 1}, .friction = 1});
  return scene;
}

TEST(InternalDamping, StillsABodyButLeavesItsMomentumAndItsSpin) {
  double left[2];
  for (const int on : {0, 1}) {
    World world(shaken(on ? 10 : 0), {});
    while (world.frame() < 30 || !solid_contacts(world).empty()) world.step();
    const Motion before = motion(world, 0);
    ASSERT_GT(glm::length(before.spin_momentum), 0.05);
    run(world, 60);
    const Motion after = motion(world, 0);
    EXPECT_LT(glm::distance(after.velocity, before.velocity), 1e-5 * glm::length(before.velocity));
    EXPECT_LT(glm::distance(after.spin_momentum, before.spin_momentum), 1e-3 * glm::length(before.spin_momentum));
    left[on] = vibration(world);
  }
  EXPECT_GT(left[0], 1e-4);
  EXPECT_LT(left[1], 0.05 * left[0]);
}

/// Relaxed once a frame and by nothing else, vibration velocities shrink by 1 / (1 + rate * dt).
TEST(InternalDamping, HasTheRateOfItsMaterial) {
  for (const double rate : {2.0, 6.0})
    for (const double frame_time : {1.0 / 60, 1.0 / 240}) {
      Material m = spring_ball();
      m.set(BendSprings::keys, {1e-9, 0});
      m.set(StructuralSprings::keys, {1e-9, 0});  // its particles fly nearly on their own
      m[Material::internal_damping] = rate;
      World world(lone_body(m), {.frame_time = frame_time});
      std::vector<Particle> shaken = particles_of(world);
      std::mt19937 random(5);  // so slow that the shape, and with it the rigid motion, stays
      for (Particle& p : shaken) p.velocity = glm::dvec3(0, 2, 0) + random_vector(random, 1e-3);
      world.set_particles(0, shaken);
      const double first = vibration(world);
      ASSERT_GT(first, 1e-8);
      constexpr int frames = 5;
      run(world, frames);
      const double expected = std::pow(1 + rate * frame_time, -2 * frames);
      EXPECT_NEAR(vibration(world) / first, expected, 1e-3 * expected) << rate << " a second in " << frame_time << " s";
      EXPECT_NEAR(motion(world, 0).velocity.y, 2, 1e-3);
    }
}

/// A ball that rolls over the ground, after `frames`.
Motion rolling(double resistance, int frames) {
  Material m = gas_ball();
  m[StructuralSprings::stiffness] = 2000;  // hardly flattened, so that the closed form holds
  m[BendSprings::stiffness] = 500;
  m[contact::rolling_resistance] = resistance;
  m[Material::internal_damping] = 20;
  Scene scene = lone_body(m, glm::dvec3(3, 0, 0));
  scene.gravity = {0, -9.81, 0};
  scene.bodies[0].position = {0, 0.51, 0};
  set_solid(scene, {Ground{0}, 1});
  World world(scene, {});
  run(world, frames);
  return motion(world, 0);
}

double rolling_speed(double resistance, int frames) { return rolling(resistance, frames).velocity.x; }

TEST(RollingResistance, SlowsByItsClosedForm) {
  const double c = 0.05, free = rolling_speed(0, 120), slowed = rolling_speed(c, 120);
  EXPECT_GT(free, 1.2);
  // m a = -f and (2/3) m R^2 a / R = f R - c R m g, rolling without slip: a = -(3/5) c g.
  const double expected = 0.6 * c * 9.81 * (120 - 20) / 60;  // it slides for the first third of a second
  EXPECT_GT(free - slowed, 0.6 * expected);
  EXPECT_LT(free - slowed, 1.6 * expected);
}

TEST(RollingResistance, StopsABallAndNeverTurnsItBack) {
  for (const int frames : {60, 120, 180, 240, 300}) EXPECT_GT(rolling_speed(0.3, frames), -0.05);
  EXPECT_LT(rolling_speed(0.3, 240), 0.1);
  EXPECT_LT(glm::length(rolling(0.3, 300).spin_momentum), 1e-3) << "nor to and fro";
  EXPECT_GT(rolling_speed(0.0, 240), 0.8);
}

/// Where a sheet ends that falls beside the middle of a solid sphere, with a closed body far off that does resist.
std::vector<Particle> tumbled_sheet(double resistance) {
  Scene scene = sheet_on_ground(1, {0, -9.81, 0}, glm::dvec3(0.0));
  remove_solids<Ground>(scene);
  set_solid(scene, {.shape = SolidSphere{.centre = {0.3, -0.5, 0.1}, .radius = 0.4}, .friction = 1});
  scene.materials[0][contact::rolling_resistance] = resistance;
  scene.materials.push_back(gas_ball());
  scene.materials[1][contact::rolling_resistance] = 1;
  add_body(scene, {50, 0, 0}, glm::dvec3(0.0));
  scene.bodies[1].material = 1;
  World world(scene, {});
  EXPECT_TRUE(world.plan().has(Stage::rolling_resistance));
  bool touched = false;
  for (int frame = 0; frame < 40; ++frame) {
    world.step();
    touched = touched || glm::length(WorldTestAccess::solid_impulse(world, 0)) > 0;
  }
  EXPECT_TRUE(touched);
  return particles_of(world, 0);
}

TEST(RollingResistance, IsThatOfClosedBodiesOnly) {
  const std::vector<Particle> free = tumbled_sheet(0), resisting = tumbled_sheet(10);
  for (std::size_t i = 0; i < free.size(); ++i) EXPECT_EQ(free[i].position, resisting[i].position) << i;
}

/// How fast a ball thrown at the ground without gravity leaves it.
double rebound(double thrown, double limit) {
  Material m = gas_ball();
  m[contact::rebound_speed] = limit;
  Scene scene = lone_body(m, glm::dvec3(0, -thrown, 0));
  scene.bodies[0].position = {0, 1, 0};
  set_solid(scene, {Ground{0}, 0.5});
  World world(scene, {});
  for (int i = 0; i < 240; ++i) world.step();
  EXPECT_TRUE(solid_contacts(world).empty()) << "it left";
  return motion(world, 0).velocity.y;
}

TEST(ReboundDamping, ThrowsNoBodyBackFasterThanItsSpeed) {
  EXPECT_GT(rebound(6, 0), 2) << "without it springs and gas throw back";
  for (const double limit : {0.5, 1.0, 2.0}) {
    const double speed = rebound(6, limit);
    EXPECT_GT(speed, 0.05 * limit);
    EXPECT_LT(speed, 1.05 * limit) << "limit " << limit;
  }
  EXPECT_LT(rebound(6, 0.5), rebound(6, 2));
}

TEST(ReboundDamping, DoesNothingToABodyInFreeFlight) {
  Material m = gas_ball();
  m[contact::rebound_speed] = 0.5;
  Scene scene = lone_body(m, glm::dvec3(0, 20, 0));
  set_solid(scene, {Ground{-1}, 0.5});
  World world(scene, {});
  run(world, 60);
  EXPECT_NEAR(motion(world, 0).velocity.y, 20, 1e-4);
}

/// One body that wobbles, turns and moves.
class ResistanceOfABody : public testing::Test {
 protected:
  ResistanceOfABody() {
    material[Material::internal_damping] = 5;
    material[contact::rolling_resistance] = 0.1;
    material[contact::rebound_speed] = 4;
    model = batch.model = make_unbalanced_body_model({}, material);
    batch.used = lane + 2;
    batch.moves[lane] = 1;
    x = v = LaneField(model->start.size());
    v.randomise(random, 1);
    for (std::size_t i = 0; i < model->start.size(); ++i) {
      x.set(i, lane, model->start[i]);
      v.set(i, lane,
            glm::dvec3(0, 2, 0) + glm::cross(glm::dvec3(1, 2, 3), model->start[i]) + random_vector(random, 0.1));
    }
  }
  RigidMotion motion() { return rigid_motion(model->start.size(), of(x), of(v)); }
  /// J/kg, of one particle, in all that is not rigid motion.
  double wobble() {
    const RigidMotion m = motion();
    double sum = 0;
    for (std::size_t i = 0; i < model->start.size(); ++i) {
      const glm::dvec3 own = of(v)(i) - m.velocity - glm::cross(m.spin, of(x)(i) - m.centre);
      sum += 0.5 * glm::dot(own, own);
    }
    return sum;
  }
  void apply(Stage stage, const SolidPush& push = {}) { apply(std::vector<Stage>{stage}, push); }
  void apply(const std::vector<Stage>& stages, const SolidPush& push) {
    Resistance resistance;
    resistance.set_plan({stages, {}, {}});
    std::array<SolidPush, lanes> pushes;
    std::array<Impact, lanes> impacts{};
    pushes[lane] = push, impacts[lane] = impact;
    resistance.apply({batch, x.field(), v.field()}, pushes, 0.02, impacts);
    impact = impacts[lane];
  }
  static BodyField of(LaneField& f) { return {f.field(), lane, lanes}; }

  static constexpr int lane = 3;
  std::mt19937 random{7};
  Material material = spring_ball();
  std::shared_ptr<const BodyModel> model;
  Batch batch;
  LaneField x{0}, v{0};
  Impact impact;
};

TEST_F(ResistanceOfABody, ActsOnlyIfThePlanHasIt) {
  const LaneField before = v;
  apply(Stage::gravity, {{0, 1, 0}, 0});
  EXPECT_EQ(v, before);
}

TEST_F(ResistanceOfABody, LeavesOtherLanesThatDoNotMove) {
  const LaneField before = v;
  apply(Stage::internal_damping, {{0, 1, 0}, 0});
  EXPECT_NE(v.at(7, lane), before.at(7, lane));
  for (std::size_t i = 0; i < model->start.size(); ++i)
    for (const int other : {lane - 1, lane + 1}) ASSERT_EQ(v.at(i, other), before.at(i, other));
}

TEST_F(ResistanceOfABody, InternallyDampsAllButRigidMotion) {
  const RigidMotion before = motion();
  const double wobble_before = wobble();
  apply(Stage::internal_damping);
  EXPECT_LT(glm::distance(motion().velocity, before.velocity), 1e-6);
  EXPECT_LT(glm::distance(motion().momentum, before.momentum), 1e-5 * glm::length(before.momentum));
  EXPECT_NEAR(wobble(), wobble_before / (1.1 * 1.1), 1e-4 * wobble_before);  // 5/s for 0.02 s
}

TEST_F(ResistanceOfABody, RollsByTheNormalImpulse) {
  const RigidMotion before = motion();
  apply(Stage::rolling_resistance);
  EXPECT_EQ(motion().momentum, before.momentum) << "nothing touches it";
  apply(Stage::rolling_resistance, {{0, 0.01, 0}, 0});
  const double lost = model->particle_mass * (glm::length(before.momentum) - glm::length(motion().momentum));
  EXPECT_NEAR(lost, 0.1 * model->radius * 0.01, 1e-3 * lost);
  EXPECT_LT(glm::distance(motion().velocity, before.velocity), 1e-6);
  apply(Stage::rolling_resistance, {{0, 1e6, 0}, 0});
  EXPECT_LT(glm::length(motion().momentum), 1e-5 * glm::length(before.momentum)) << "it stops, and does not turn back";
}

TEST_F(ResistanceOfABody, DampsARebound) {
  const glm::dvec3 before = motion().velocity;
  const double impulse = 0.5 * material[Material::mass] * material[contact::rebound_speed];
  apply(Stage::rebound_damping, {{0, impulse, 0}, 0});
  EXPECT_NEAR(motion().velocity.y, 0.5 * before.y, 1e-5);
  EXPECT_NEAR(motion().velocity.x, before.x, 1e-6);
}

/// The damper takes half of the speed at once, and restitution gives the energy of that back in the next frame.
TEST_F(ResistanceOfABody, ReturnsWhatItDampedOfARebound) {
  const glm::dvec3 before = motion().velocity;
  const double impulse = 0.5 * material[Material::mass] * material[contact::rebound_speed];
  impact = {.speed = 10, .parting = float(before.y)};
  apply({Stage::rebound_damping, Stage::restitution}, {{0, impulse, 0}, 1});
  EXPECT_NEAR(motion().velocity.y, before.y / 2, 1e-3);
  apply(Stage::restitution);
  EXPECT_NEAR(motion().velocity.y, before.y, 1e-5);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
