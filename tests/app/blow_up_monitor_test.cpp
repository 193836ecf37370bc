// The blow-up monitor on invented figures and on real blow-ups.

#include <gtest/gtest.h>

#include <glm/vec2.hpp>

#include "app/session/simulation.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/springs.h"
#include "softbody/model/body_model.h"
#include "tests/app/scenes.h"
#include "tests/support/change.h"

namespace app {
namespace THIS_FILE {

/// Looks at invented figures of a world that stands still.
class BlowUpMonitorTest : public testing::Test {
 protected:
  BlowUpMonitorTest() {
    while (world.frame() < 20) world.step();
    bodies = softbody::measure_bodies(world);
    EXPECT_FALSE(blow_up());
  }
  std::optional<compare::BlowUp> blow_up() { return monitor.check(world, bodies); }
  void expect_blow_up_of(softbody::BodyId body, const std::string& says) {
    const auto found = blow_up();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->body, body);
    EXPECT_EQ(found->frame, 20);
    EXPECT_NE(found->what.find(says), std::string::npos) << found->what;
  }

  softbody::World world{touching_pair(), {}};
  std::vector<softbody::BodyMeasures> bodies;
  compare::BlowUpMonitor monitor;
};

TEST_F(BlowUpMonitorTest, ReportsABodyThatIsNotFinite) {
  bodies[1].finite = false;
  expect_blow_up_of(1, "Body 1 is no longer finite");
}

TEST_F(BlowUpMonitorTest, ReportsABodyThatGainsEnergyFromNowhere) {
  const double active = softbody::total(bodies).energies.kinetic;  // J, at least
  bodies[1].energy.elastic += 0.09 * active;
  EXPECT_FALSE(blow_up()) << "a tenth is allowed";
  bodies[1].energy.elastic += 2 * active;
  expect_blow_up_of(1, "Body 1 gained energy");
  EXPECT_FALSE(blow_up()) << "it stays at that";
}

TEST_F(BlowUpMonitorTest, ReportsASingleFastParticle) {
  bodies[0].energy.kinetic += world.model(0).particle_mass / 2 * 60 * 60;
  expect_blow_up_of(0, "Body 0 gained energy");
}

TEST_F(BlowUpMonitorTest, StartsAnewAfterRestart) {
  monitor.restart();
  bodies[0].energy.elastic += 1000;
  EXPECT_FALSE(blow_up());
  EXPECT_FALSE(blow_up());
  bodies[0].energy.elastic += 1000;
  EXPECT_TRUE(blow_up());
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
        session::Simulation simulation(scene, 1);
        while (simulation.world().frame() < 60 && !simulation.stability().blow_up()) run(simulation, 1);
        EXPECT_FALSE(simulation.stability().blow_up()) << stiffness << " N/m, " << apart.x << ' ' << apart.y
                                                       << " apart: " << simulation.stability().blow_up()->what;
        EXPECT_EQ(simulation.world().bodies().count(), 2u);
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
  scene.solids.clear();
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
  for (int i = 0; i < 60; ++i) watched.look();
}

/// Gas whose pressure changes suddenly makes bodies swing as fast as explicit steps can follow.
TEST(BlowUpMonitor, AcceptsBodiesThatSwingFast) {
  for (const double pressure : {0.0, 111e3, 116e3, 150e3}) {  // Pa
    softbody::Scene scene = touching_pair();
    softbody::Material& rubber = scene.materials[0];
    rubber[softbody::GasPressure::inside] = 113e3, rubber[softbody::GasPressure::outside] = 101'325;
    rubber[softbody::Material::start_in_equilibrium] = true;
    session::Simulation simulation(scene, 1);
    run(simulation, 15);
    rubber[softbody::GasPressure::inside] = pressure;
    simulation.change_scene("Material", [&](softbody::Scene& s) { s.materials[0] = rubber; });
    while (simulation.world().frame() < 45 && !simulation.stability().blow_up()) run(simulation, 1);
    EXPECT_FALSE(simulation.stability().blow_up()) << pressure << " Pa: " << simulation.stability().blow_up()->what;
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
