// Implicit steps of bodies that turn, in the air and on the ground, and what they are made of.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "softbody/implicit_energy.h"
#include "softbody/implicit_frames.h"
#include "softbody/implicit_planes.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace {

Material ball_of(double stiffness) {
  Material m = gas_ball();
  m.structural = {stiffness, 0.1};
  m.bend = {stiffness / 4, 0.1};
  m.gas_pressure = 1.6 * stiffness;
  m.rolling_resistance = 0;
  return m;
}

std::vector<Particle> particles_of(const World& world) {
  std::vector<Particle> all;
  for (Index i = 0; i < world.prototype(0).mesh.vertices.size(); ++i) all.push_back(world.dynamics().particle(0, i));
  return all;
}

RigidMotion rigid(const std::vector<Particle>& all) {
  return rigid_motion(
      all.size(), [&](std::size_t i) { return all[i].position; }, [&](std::size_t i) { return all[i].velocity; });
}

/// m/s, the root of the mean square of what is not rigid motion.
double internal_speed(const std::vector<Particle>& all) {
  const RigidMotion m = rigid(all);
  double sum = 0;
  for (const Particle& p : all) {
    const glm::dvec3 own = p.velocity - m.velocity - glm::cross(m.spin, p.position - m.centre);
    sum += glm::dot(own, own) / double(all.size());
  }
  return std::sqrt(sum);
}

void set_motion(World& world, const glm::dvec3& velocity, const glm::dvec3& spin) {
  std::vector<Particle> all = particles_of(world);
  const glm::dvec3 centre = rigid(all).centre;
  for (Particle& p : all) p.velocity = velocity + glm::cross(spin, p.position - centre);
  world.set_particles(0, all);
}

/// Steps along chords swell a body, leave its velocities behind, and drain its spin.
TEST(ImplicitSpin, GoesOnAsOnePiece) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(3, 18, -5));
  for (const double dt : {1.0 / 60, 1.0 / 240})
    for (const double stiffness : {1e5, 1e6, 1e8})
      for (const double spin : {2.0, 20.0}) {
        SCOPED_TRACE(testing::Message() << stiffness << " N/m, " << spin << " rad/s, " << dt << " s");
        World world(lone_body(ball_of(stiffness)), {.frame_time = dt, .integrator = "implicit", .substeps = 1});
        set_motion(world, glm::dvec3(0.0), spin * axis);
        const glm::dvec3 start = particles_of(world)[0].position;
        run(world, int(std::lround(1 / dt)));
        const std::vector<Particle> end = particles_of(world);
        EXPECT_LT(glm::distance(rigid(end).spin, spin * axis), 3e-4 * spin);
        EXPECT_LT(internal_speed(end), 3e-5) << "m/s";
        if (stiffness < 1e8) continue;
        const glm::dvec3 along = glm::dot(start, axis) * axis, out = start - along;
        const glm::dvec3 place = along + std::cos(spin) * out + std::sin(spin) * glm::cross(axis, out);
        EXPECT_LT(glm::distance(end[0].position, place), 1e-3) << "m";
      }
}

/// It swells as much as short explicit steps have it.
TEST(ImplicitSpin, SwellsAsItShould) {
  const auto radius = [](const char* integrator, double dt, int substeps) {
    World world(lone_body(ball_of(1e3)), {.frame_time = dt, .integrator = integrator, .substeps = substeps});
    set_motion(world, glm::dvec3(0.0), {0, 10, 0});
    run(world, int(std::lround(3 / dt)));
    double most = 0;
    for (const Particle& p : particles_of(world)) most = std::max(most, std::hypot(p.position.x, p.position.z));
    return most;
  };
  const double truth = radius("velocity-verlet", 1.0 / 60, 64);
  const World at_rest(lone_body(ball_of(1e3)), {});
  double before = 0;
  for (const Particle& p : particles_of(at_rest)) before = std::max(before, std::hypot(p.position.x, p.position.z));
  ASSERT_GT(truth - before, 1e-3) << "m";
  EXPECT_NEAR(radius("implicit", 1.0 / 60, 1), truth, 0.05 * (truth - before));
}

TEST(ImplicitSpin, RollsOn) {
  for (const double stiffness : {1e5, 1e7}) {
    Scene scene = lone_body(ball_of(stiffness));
    scene.gravity = {0, -9.81, 0};
    scene.ground.emplace();
    scene.bodies[0].position = {0, 0.6, 0};
    World world(scene, {.integrator = "implicit", .substeps = 1});
    run(world, 90);
    const double height = rigid(particles_of(world)).centre.y;
    set_motion(world, {20 * height, 0, 0}, {0, 0, -20});
    const double energy = measure(world).energy;
    for (int frame = 0; frame < 60; ++frame) {
      world.step();
      ASSERT_LT(measure(world).energy, energy + 0.01 * 9.81) << stiffness << " N/m, frame " << frame;
    }
    const RigidMotion end = rigid(particles_of(world));
    EXPECT_NEAR(end.spin.z, -20, 0.5) << stiffness;
    EXPECT_NEAR(end.velocity.x, 20 * height, 0.5) << stiffness;
  }
}

/// A slender strip, crumpled and tumbling: springs, and what takes back energy, leave both momenta alone.
TEST(ImplicitSpin, KeepsMomentumInTheAir) {
  for (const double stiffness : {1e2, 1e4, 1e6})
    for (const double width : {0.05, 0.01}) {
      SCOPED_TRACE(testing::Message() << stiffness << " N/m, " << width << " m wide");
      Material m;
      m.structural = {stiffness, 0.1};
      m.shear = {stiffness / 2, 0.1};
      m.bend = {stiffness / 10, 0.1};
      Scene scene = lone_body(m);
      scene.bodies[0].mesh = {.kind = "grid", .columns = 30, .rows = 1, .width = 2, .depth = width};
      World world(scene, {.integrator = "implicit", .substeps = 1});
      std::mt19937 random(1);
      std::vector<Particle> all = particles_of(world);
      for (Particle& p : all)
        p.velocity = glm::cross(glm::dvec3(0, 1, 10), p.position) +
                     glm::dvec3(uniform(random, 0, 1), uniform(random, -1, 1), uniform(random, -1, 1));
      world.set_particles(0, all);
      const RigidMotion before = rigid(particles_of(world));
      const double energy = measure(world).energy;
      for (int frame = 0; frame < 60; ++frame) {
        world.step();
        ASSERT_LT(measure(world).energy, energy + 0.1) << "J, frame " << frame;
      }
      const RigidMotion after = rigid(particles_of(world));
      EXPECT_LT(glm::distance(after.velocity, before.velocity), 1e-5);
      EXPECT_LT(glm::distance(after.momentum, before.momentum), 1e-4 * glm::length(before.momentum));
    }
}

/// What throws it back is its fall, not its spin.
TEST(ImplicitSpin, LeavesASmoothSolidNoFasterThanItShould) {
  for (const double dt : {1.0 / 60, 1.0 / 240})
    for (const double stiffness : {1e4, 1e6})
      for (const double spin : {0.0, 40.0, 80.0}) {
        SCOPED_TRACE(testing::Message() << stiffness << " N/m, " << spin << " rad/s, " << dt << " s");
        Scene scene = lone_body(ball_of(stiffness));
        scene.gravity = {0, -9.81, 0};
        scene.ground.emplace();
        scene.ground->friction = 0, scene.ground->restitution = 0.8;
        scene.bodies[0].position = {0, 2, 0};
        World world(scene, {.frame_time = dt, .integrator = "implicit", .substeps = 1});
        set_motion(world, glm::dvec3(0.0), {0, 0, spin});
        const double energy = measure(world).energy;
        double fastest = 0;
        for (int frame = 0; frame * dt < 1; ++frame) {
          world.step();
          const Measures m = measure(world);
          ASSERT_TRUE(m.finite) << frame;
          ASSERT_LT(m.energy, energy + 0.2) << "J, frame " << frame;
          fastest = std::max(fastest, rigid(particles_of(world)).velocity.y);
        }
        if (stiffness < 1e6) continue;  // it swings, too
        EXPECT_LT(fastest, 4.6) << "m/s; it comes with 5.3";
      }
}

glm::dvec3 at(const Lanes& f, std::size_t particle, std::size_t lane) {
  const std::size_t stride = f.size() / 3, i = particle * lanes + lane;
  return {f[i], f[i + stride], f[i + 2 * stride]};
}
void put(Lanes& f, std::size_t particle, std::size_t lane, const glm::dvec3& value) {
  for (std::size_t k = 0; k < 3; ++k) f[k * f.size() / 3 + particle * lanes + lane] = value[int(k)];
}

/// Four particles in lane 2 that fly and spin as one, the same in lane 5, which has the world's frame.
struct Flight {
  static constexpr double h = 0.1;
  const glm::dvec3 velocity{1, -2, 3}, spin{0.5, 4, -6}, gravity{0, -9.81, 0}, fall = h * h / 2 * gravity;
  const std::vector<glm::dvec3> places{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {-1, -2, 0}};  // from the centre
  const glm::dvec3 centre{7, 8, 9};
  Lanes x = Lanes(3 * 4 * lanes), v = x;
  Flight() {
    for (const std::size_t lane : {2u, 5u})
      for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 out = places[i] - middle();
        put(x, i, lane, centre + out);
        put(v, i, lane, velocity + glm::cross(spin, out));
      }
  }
  glm::dvec3 middle() const { return (places[0] + places[1] + places[2] + places[3]) / 4.0; }
  ImplicitFrames frames() const {
    std::array<bool, lanes> which{};
    which[2] = true;
    return ImplicitFrames(x, v, which, h, gravity).some(which, fall);
  }
};

TEST(ImplicitFrames, TakeARigidMotionAlong) {
  constexpr double nearly = 0.01;  // how near the frame's spin comes to the body's
  const Flight f;
  const ImplicitFrames frames = f.frames();
  Lanes x = f.x, v = f.v, carried(x.size()), a(x.size());
  frames.enter(x, v, carried);
  frames.accelerations(x, v, a);
  Lanes end_x = x, end_v = v;
  frames.leave(end_x, end_v);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 out = f.places[i] - f.middle(), round = glm::cross(f.spin, out),
                     inwards = glm::cross(f.spin, round);
    EXPECT_LT(glm::distance(at(x, i, 2), out), 1e-12);
    EXPECT_LT(glm::length(at(v, i, 2)), nearly * glm::length(round));
    EXPECT_LT(glm::distance(at(a, i, 2), -inwards), nearly * glm::length(inwards));
    const glm::dvec3 turned = rotation(f.h * f.spin) * out, place = out + frames.turn(2, at(f.x, i, 2));
    EXPECT_LT(glm::distance(place, turned), nearly * f.h * glm::length(round));
    EXPECT_LT(glm::distance(at(end_x, i, 2), f.centre + f.h * f.velocity + f.fall + place), 1e-12);
    EXPECT_LT(glm::distance(at(end_v, i, 2), f.velocity + f.h * f.gravity + frames.leave(2, round)), 1e-12);
    // In the frame it is so far from where it was in the world.
    EXPECT_NEAR(glm::length(at(carried, i, 2)), glm::distance(at(end_x, i, 2), at(f.x, i, 2)), 1e-12);
    EXPECT_EQ(at(x, i, 5), at(f.x, i, 5));
    EXPECT_EQ(at(a, i, 5), f.gravity);
    EXPECT_EQ(at(carried, i, 5), glm::dvec3(0.0));
    EXPECT_EQ(at(end_x, i, 5), at(f.x, i, 5));
  }
}

TEST(ImplicitFrames, TurnDirectionsAndForcesAlike) {
  const Flight f;
  const ImplicitFrames frames = f.frames();
  Lanes x = f.x, v = f.v, carried(x.size());
  frames.enter(x, v, carried);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(1, 2, -1));
  Lanes end_x = x, end_v = v;
  frames.leave(end_x, end_v);
  const glm::dvec3 moved = at(end_x, 3, 2) - at(f.x, 3, 2);
  EXPECT_NEAR(glm::dot(at(carried, 3, 2), frames.enter(2, normal)), glm::dot(moved, normal), 1e-12);
  EXPECT_LT(glm::distance(frames.leave(2, frames.enter(2, normal)), normal), 1e-12);
}

TEST(Rotation, IsTheOneOfItsVector) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1, -2, 2)), out = glm::cross(axis, glm::dvec3(1, 0, 0));
  for (const double angle : {0.0, 1e-8, 0.3, 2.0, 6.0}) {
    const glm::dvec3 turned = rotation(angle * axis) * out;
    EXPECT_LT(glm::distance(turned, std::cos(angle) * out + std::sin(angle) * glm::cross(axis, out)),
              1e-5 * angle * angle * angle + 1e-12);
    EXPECT_NEAR(glm::determinant(rotation(angle * axis)), 1, 1e-12);
  }
}

TEST(ImplicitFrames, TurnShields) {
  const Flight f;
  const ImplicitFrames frames = f.frames();
  LinearShield shield{.at = 2, .normal = glm::normalize(glm::dvec3(1, 2, -1)), .slopes = {}, .force = {3, 5, -4}};
  shield.slopes.spring = 10, shield.slopes.damper = 2, shield.slopes.across_spring = 7, shield.slopes.across_damper = 1;
  shield.friction = 0.5, shield.partner = {0.1, 0.2, 0.3}, shield.as_now = {-0.1, 0.2, 0.1};
  const LinearShield turned = frames.enter(shield);
  const glm::dvec3 moved(0.2, -0.1, 0.05);
  ASSERT_GT(glm::length(shield.after(moved)), 1);
  EXPECT_LT(glm::distance(frames.leave(2, turned.after(frames.enter(2, moved))), shield.after(moved)), 1e-10);
}

/// Along an axis to which all is near, what swings looks like a fast spin.
TEST(ImplicitFrames, DoNotFollowATremor) {
  Lanes x(3 * 4 * lanes), v = x;
  const double thin = 1e-3;
  for (std::size_t i = 0; i < 4; ++i) {
    put(x, i, 0, {double(i) - 1.5, i % 2 ? thin : -thin, i < 2 ? thin : -thin});
    put(v, i, 0, glm::cross(glm::dvec3(50, 0, 2), at(x, i, 0)));
  }
  std::array<bool, lanes> which{};
  which[0] = true;
  const ImplicitFrames frames(x, v, which, 1e-3, glm::dvec3(0.0));
  EXPECT_LT(glm::distance(frames.turn(0, {0, 1, 0}) / 1e-3, glm::cross(glm::dvec3(0, 0, 2), glm::dvec3(0, 1, 0))), 0.1);
}

/// One lane's work of a step in which a ball's particles all move with 2 m/s.
struct Moving {
  std::shared_ptr<const Prototype> prototype = make_prototype({}, ball_of(1e4));
  ImplicitWork work{*prototype, implicit_kernels(best_isa())};
  double kinetic = 0.5 * prototype->material.mass * 4;  // J
  Moving() {
    work.end_x = work.x;
    for (std::size_t i = 0; i < prototype->mesh.vertices.size(); ++i) {
      put(work.x, i, 1, prototype->start[i]);
      put(work.v, i, 1, {2, 0, 0});
    }
    work.end_x = work.x, work.end_v = work.v;
  }
};

TEST(ImplicitEnergy, TakesBackWhatIsUndue) {
  for (const bool pushed : {false, true}) {
    Moving m;
    EXPECT_EQ(undue_energy(*m.prototype, m.work, 1, glm::dvec3(0.0), pushed), 0);
    std::mt19937 random(1);
    glm::dvec3 momentum(0.0);
    const std::size_t n = m.prototype->mesh.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
      const glm::dvec3 more(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
      put(m.work.v, i, 1, at(m.work.v, i, 1) + more);
      put(m.work.end_v, i, 1, at(m.work.end_v, i, 1) + 1.01 * more);
      momentum += at(m.work.end_v, i, 1);
    }
    const double undue = undue_energy(*m.prototype, m.work, 1, glm::dvec3(0.0), pushed);
    EXPECT_NEAR(undue, 0.5 * (1.01 * 1.01 - 1), 0.1 * undue) << "J";
    EXPECT_TRUE(take_back(*m.prototype, m.work, 1, undue, pushed));
    EXPECT_EQ(undue_energy(*m.prototype, m.work, 1, glm::dvec3(0.0), pushed), 0);
    glm::dvec3 left(0.0);
    for (std::size_t i = 0; i < n; ++i) left += at(m.work.end_v, i, 1);
    if (!pushed) {
      EXPECT_LT(glm::distance(left, momentum), 1e-9);
    }
    const Lanes before = m.work.end_v;
    EXPECT_FALSE(take_back(*m.prototype, m.work, 1, 2 * m.kinetic, pushed));
    EXPECT_FALSE(take_back(*m.prototype, m.work, 1, std::numeric_limits<double>::infinity(), pushed));
    EXPECT_EQ(m.work.end_v, before);
  }
}

TEST(GoOnAsOne, LeavesARigidMotionAsItIs) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    Moving m;
    const auto any = [&] { return glm::dvec3(uniform(random, -5, 5), uniform(random, -5, 5), uniform(random, -5, 5)); };
    const glm::dvec3 velocity = any(), spin = any();
    const std::size_t n = m.prototype->mesh.vertices.size();
    for (std::size_t k = 0; k < n; ++k) put(m.work.v, k, 1, velocity + glm::cross(spin, m.prototype->start[k]));
    go_on_as_one(m.work, 1, 0.01, glm::dvec3(0.0));
    const RigidMotion end = rigid_motion(
        n, [&](std::size_t k) { return at(m.work.end_x, k, 1); },
        [&](std::size_t k) { return at(m.work.end_v, k, 1); });
    const RigidMotion start = rigid_motion(
        n, [&](std::size_t k) { return at(m.work.x, k, 1); }, [&](std::size_t k) { return at(m.work.v, k, 1); });
    ASSERT_LT(glm::distance(end.momentum, start.momentum), 1e-3 * glm::length(start.momentum)) << "rest: energy";
    ASSERT_LT(glm::distance(end.velocity, velocity), 1e-9);
  }
}

/// Its planes stop it, its spin goes on.
TEST(GoOnAsOne, KeepsSpinAndStopsAtPlanes) {
  Moving m;
  const std::size_t n = m.prototype->mesh.vertices.size();
  const glm::dvec3 spin(0, 3, 0);
  for (std::size_t i = 0; i < n; ++i)
    put(m.work.v, i, 1, glm::dvec3(2, -1, 0) + glm::cross(spin, m.prototype->start[i]));
  for (std::size_t i = 0; i < n; ++i)
    m.work.planes.push_back({.at = i * lanes + 1,
                             .friction = 0,
                             .restitution = 0,
                             .normal = {0, 1, 0},
                             .need = 0,
                             .out = 0,
                             .force = {1, 1, 1}});
  go_on_as_one(m.work, 1, 0.01, glm::dvec3(0.0));
  const RigidMotion end = rigid_motion(
      n, [&](std::size_t i) { return at(m.work.end_x, i, 1); }, [&](std::size_t i) { return at(m.work.end_v, i, 1); });
  EXPECT_LT(glm::distance(end.spin, spin), 0.01);
  EXPECT_LT(glm::distance(end.velocity, glm::dvec3(2, 0, 0)), 1e-9);
  EXPECT_EQ(m.work.planes[0].force, glm::dvec3(0.0));
}

}  // namespace
}  // namespace softbody::test
