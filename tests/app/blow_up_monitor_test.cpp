// The blow-up monitor on invented figures and on real blow-ups.

#include <gtest/gtest.h>

#include <glm/vec2.hpp>

#include "app/session/session.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/springs.h"
#include "softbody/model/body_model.h"
#include "tests/app/scenes.h"
#include "tests/support/change.h"

namespace app {
namespace THIS_FILE {

softbody::World pair_after(int frames) {
  softbody::World world(touching_pair(), {});
  for (int i = 0; i < frames; ++i) world.step();
  return world;
}

TEST(BlowUpMonitor, ReportsABodyThatIsNotFinite) {
  const softbody::World world = pair_after(1);
  auto bodies = softbody::measure_bodies(world);
  compare::BlowUpMonitor monitor;
  EXPECT_FALSE(monitor.check(world, bodies));
  bodies[1].finite = false;
  const auto blow_up = monitor.check(world, bodies);
  ASSERT_TRUE(blow_up);
  EXPECT_EQ(blow_up->body, 1u);
  EXPECT_EQ(blow_up->frame, 1);
  EXPECT_NE(blow_up->what.find("Body 1 is no longer finite"), std::string::npos) << blow_up->what;
}

TEST(BlowUpMonitor, ReportsABodyThatGainsEnergyFromNowhere) {
  const softbody::World world = pair_after(20);
  auto bodies = softbody::measure_bodies(world);
  const double active = softbody::total(bodies).energies.kinetic;  // J, at least
  compare::BlowUpMonitor monitor;
  EXPECT_FALSE(monitor.check(world, bodies));
  bodies[1].energy.elastic += 0.09 * active;
  EXPECT_FALSE(monitor.check(world, bodies)) << "a tenth is allowed";
  bodies[1].energy.elastic += 2 * active;
  const auto blow_up = monitor.check(world, bodies);
  ASSERT_TRUE(blow_up);
  EXPECT_EQ(blow_up->body, 1u);
  EXPECT_NE(blow_up->what.find("energy"), std::string::npos) << blow_up->what;
  EXPECT_FALSE(monitor.check(world, bodies)) << "it stays at that";
}

TEST(BlowUpMonitor, ReportsASingleFastParticle) {
  const softbody::World world = pair_after(1);
  auto bodies = softbody::measure_bodies(world);
  compare::BlowUpMonitor monitor;
  EXPECT_FALSE(monitor.check(world, bodies));
  bodies[0].energy.kinetic += world.model(0).particle_mass / 2 * 60 * 60;
  const auto blow_up = monitor.check(world, bodies);
  ASSERT_TRUE(blow_up);
  EXPECT_EQ(blow_up->body, 0u);
}

TEST(BlowUpMonitor, StartsAnewAfterRestart) {
  const softbody::World world = pair_after(1);
  auto bodies = softbody::measure_bodies(world);
  compare::BlowUpMonitor monitor;
  EXPECT_FALSE(monitor.check(world, bodies));
  monitor.restart();
  bodies[0].energy.elastic += 1000;
  EXPECT_FALSE(monitor.check(world, bodies));
  EXPECT_FALSE(monitor.check(world, bodies));
  bodies[0].energy.elastic += 1000;
  EXPECT_TRUE(monitor.check(world, bodies));
}

/// Nothing else moves, so the energy that separates the two is all the energy there is.
TEST(BlowUpMonitor, AcceptsABodyAddedInsideAnother) {
  for (const auto surface : {softbody::ContactSurface::vertices, softbody::ContactSurface::surfaces})
    for (const double stiffness : {200.0, 3e5})  // N/m
      for (const glm::dvec2 apart : {glm::dvec2(0.05, 0.02), {0.1, 0.2}, {0.5, 0.2}, {0.9, 0.2}, {1.02, 0}}) {
        softbody::Scene scene = touching_pair();
        scene.gravity = glm::dvec3(0.0);
        scene.materials[0][softbody::StructuralSprings::stiffness] = stiffness;
        scene.contact_surface = surface;
        scene.bodies[1].position = scene.bodies[0].position + glm::dvec3(apart, 0);
        scene.bodies[1].appear = 5;
        Session session(scene, {}, 1);
        while (session.world().frame() < 90 && !session.simulation.stability().blow_up()) session.advance(tick);
        EXPECT_FALSE(session.simulation.stability().blow_up())
            << stiffness << " N/m, " << apart.x << ' ' << apart.y
            << " apart: " << session.simulation.stability().blow_up()->what;
        EXPECT_EQ(session.world().bodies().count(), 2u);
      }
}

/// The body gets another gas while it is held, so it is far from its equilibrium.
TEST(BlowUpMonitor, AcceptsAHeldBodyThatSpringsBack) {
  softbody::Scene scene = touching_pair();
  scene.bodies.resize(1);
  scene.bodies[0].release = 10;
  scene.gravity = glm::dvec3(0.0);
  scene.materials[0][softbody::GasPressure::inside] = 300'000;
  scene.materials[0][softbody::GasPressure::outside] = 101'325;
  scene.materials[0][softbody::Material::start_in_equilibrium] = false;
  softbody::World world(scene, {});
  compare::BlowUpMonitor monitor;
  double fastest = 0;
  for (int i = 0; i < 60; ++i) {
    world.step();
    const auto bodies = softbody::measure_bodies(world);
    fastest = std::max(fastest, bodies[0].max_speed);
    const auto blow_up = monitor.check(world, bodies);
    ASSERT_FALSE(blow_up) << "frame " << i << ": " << blow_up->what;
  }
  EXPECT_GT(fastest, 10);
}

/// Looks at each frame of a world that gains energy by the work of contacts, first as it is, then with more energy.
class Watched {
 public:
  explicit Watched(const softbody::Scene& scene) : world(scene, {}) { look(); }
  void look() {
    world.step();
    auto bodies = softbody::measure_bodies(world);
    const auto blow_up = monitor_.check(world, bodies);
    EXPECT_FALSE(blow_up) << "frame " << world.frame() << ": " << blow_up->what;
    const softbody::Energy all = softbody::total(bodies).energies;
    const double more = 1 + 0.2 * (all.kinetic + all.elastic);  // J
    bodies[0].energy.elastic += more;
    EXPECT_TRUE(monitor_.check(world, bodies)) << "a blow-up in frame " << world.frame();
    bodies[0].energy.elastic -= more;
    monitor_.check(world, bodies);
    most = std::max(most, softbody::measure(world).energy);
  }
  softbody::World world;
  double most = -1e9;  // J

 private:
  compare::BlowUpMonitor monitor_;
};

TEST(BlowUpMonitor, AcceptsABodyPushedOutOfASolid) {
  softbody::Scene scene = touching_pair();
  scene.bodies.resize(1);
  remove_solids<softbody::Ground>(scene);
  Watched watched(scene);
  for (int i = 0; i < 4; ++i) watched.look();
  const double start = softbody::measure(watched.world).energy;
  add_solid(scene,
            {softbody::SolidSphere{.centre = watched.world.body(0).origin - glm::dvec3(0.1, 0.3, 0), .radius = 1}});
  softbody::change(watched.world, [&](softbody::Scene& s) { s.solids = scene.solids; });
  for (int frame = 0; frame < 5 || softbody::measure(watched.world).deepest_penetration > 0; ++frame) {
    ASSERT_LT(frame, 600);
    watched.look();
  }
  EXPECT_GT(watched.most, start + 9.81 * watched.world.model(0).radius) << "or nothing pushed it out";
}

/// A row of overlapping bodies, each of which is pushed away from the next.
TEST(BlowUpMonitor, AcceptsOverlappingSurfacesThatSeparate) {
  softbody::Scene scene = touching_pair();
  scene.gravity = glm::dvec3(0.0);
  remove_solids<softbody::SolidSphere>(scene);
  remove_solids<softbody::Ground>(scene);
  scene.bodies.resize(24, scene.bodies[0]);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) scene.bodies[b].position = {0.4 * double(b), 0, 0};
  scene.contact_surface = softbody::ContactSurface::surfaces;
  Watched watched(scene);
  const double first = softbody::measure(watched.world).energy;
  for (int i = 0; i < 100; ++i) watched.look();
  EXPECT_GT(watched.most, 1.5 * first);
}

/// Sheets in one plane, which never separate.
TEST(BlowUpMonitor, JudgesSurfacesThatNeverSeparate) {
  softbody::Scene scene = touching_pair();
  scene.gravity = glm::dvec3(0.0);
  for (softbody::BodySource& body : scene.bodies) {
    body.mesh = {.kind = "grid", .columns = 6, .rows = 6, .width = 1, .depth = 1};
    body.position = {0, 4, 0};
  }
  scene.bodies[1].position += glm::dvec3(0.02, 0, 0.01);
  scene.contact_surface = softbody::ContactSurface::surfaces;
  Watched watched(scene);
  for (int i = 0; i < 120; ++i) watched.look();
}

/// Gas whose pressure changes suddenly makes bodies swing as fast as explicit steps can follow.
TEST(BlowUpMonitor, AcceptsBodiesThatSwingFast) {
  for (const double pressure : {0.0, 90e3, 111e3, 114e3, 116e3, 119e3, 125e3, 150e3}) {  // Pa
    softbody::Scene scene = touching_pair();
    softbody::Material& rubber = scene.materials[0];
    rubber[softbody::GasPressure::inside] = 113e3, rubber[softbody::GasPressure::outside] = 101'325;
    rubber[softbody::Material::start_in_equilibrium] = true;
    Session session(scene, {}, 1);
    while (session.world().frame() < 15) session.advance(tick);
    rubber[softbody::GasPressure::inside] = pressure;
    session.simulation.change_scene("Material", [&](softbody::Scene& s) { s.materials[0] = rubber; });
    while (session.world().frame() < 60 && !session.simulation.stability().blow_up()) session.advance(tick);
    EXPECT_FALSE(session.simulation.stability().blow_up())
        << pressure << " Pa: " << session.simulation.stability().blow_up()->what;
  }
}

/// Springs far too stiff for a single substep a frame.
TEST(BlowUpMonitor, ReportsTheBlowUpOfEveryExplicitIntegrator) {
  softbody::Scene scene = touching_pair();
  scene.materials[0][softbody::StructuralSprings::stiffness] = 1e5;
  for (const char* integrator : {"explicit-euler", "semi-implicit-euler", "velocity-verlet", "rk4"}) {
    softbody::World world(scene, {.integrator = {integrator, 1}});
    compare::BlowUpMonitor monitor;
    std::optional<compare::BlowUp> blow_up;
    while (!blow_up && world.frame() < 10) {
      world.step();
      blow_up = monitor.check(world, softbody::measure_bodies(world));
    }
    EXPECT_TRUE(blow_up) << integrator;
  }
}

}  // namespace THIS_FILE
}  // namespace app
