// Cells of `report stability` in which bodies join a running world: they are credited with what they bring, and no
// more.

#include "app/report/stability/results.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "softbody/contact/keys.h"
#include "tests/solids.h"

namespace app::test {
namespace THIS_FILE {

constexpr double dt = 1.0 / 30;  // s

/// Returns balls in balance, R = 0.5 m, that join one after another, without gravity, solids and sleep.
softbody::Scene balls(std::initializer_list<softbody::BodySource> sources, double stiffness = 1e3) {
  softbody::Scene scene = report::lone_scene(report::ball_material(stiffness, 0.1));
  const softbody::MeshSource mesh = scene.bodies[0].mesh;
  scene.bodies = sources;
  for (softbody::BodySource& body : scene.bodies) body.mesh = mesh;
  return scene;
}

softbody::BodySource joiner(int appear, const glm::dvec3& position, const glm::dvec3& velocity = glm::dvec3(0.0)) {
  softbody::BodySource body;
  body.position = position, body.velocity = velocity;
  body.appear = body.release = appear;
  return body;
}

reference::StabilityFigures run(const softbody::Scene& scene, std::string_view integrator, int frames) {
  report::StabilityStart start = report::prepare({.scene = scene}, frames * dt);
  start.not_judged = "bodies join";
  const reference::StabilityFigures figures = report::run_cell(start, *softbody::find_integrator(integrator), dt);
  EXPECT_EQ(figures.refused, "");
  return figures;
}

/// An explicit Euler step adds 1/2 m (g dt)^2 to a body that begins to fall, a Verlet step nothing.
TEST(StabilityCell, CountsTheGainOfAJoiningBodyInItsFirstFrame) {
  constexpr int appear = 5;
  for (const double height : {-40.0, 40.0}) {  // m: also one whose energy is negative
    softbody::Scene scene = balls({joiner(0, {9, 0, 0}), joiner(appear, {0, height, 0}, {0, 3, 0})});
    scene.bodies[0].release = 1000;  // held in place: it gains nothing
    scene.gravity = {0, -98.1, 0};
    const double gain = 0.5 * std::pow(98.1 * dt, 2) / (2 * 9.81 * report::prepare({.scene = scene}, 1).limits.radius);
    const reference::StabilityFigures before = run(scene, "explicit-euler", appear),
                                      after = run(scene, "explicit-euler", 6);
    EXPECT_NEAR(before.energy, 0, 1e-4) << height;
    EXPECT_NEAR(after.energy, gain, 0.01 * gain) << height;
    EXPECT_GT(gain, 5 * reference::stability_bounds.energy) << height;
    EXPECT_NEAR(run(scene, "velocity-verlet", 6).energy, 0, 1e-3) << height;
  }
}

/// Returns a ball with stiff penalty contact, and a second ball that joins.
softbody::Scene joined_by(const softbody::BodySource& second) {
  softbody::Scene scene = balls({joiner(0, {0, 0, 0}), second});
  scene.materials[0][softbody::contact::stiffness] = 1e8;
  scene.bodies[0].release = 1000;
  return scene;
}

TEST(StabilityCell, CreditsAJoiningBodyWithTheEnergyOfItsContacts) {
  softbody::Scene scene = joined_by(joiner(3, {0.7, 0.01, 0.02}));
  scene.materials[0][softbody::contact::stiffness] = 1e3;
  EXPECT_LE(run(scene, "auto", 12).energy, reference::stability_bounds.energy);
}

/// It flies into the other ball from afar. In that frame no penalty contact has acted, and explicit Euler adds 1/2 m (g
/// dt)^2.
TEST(StabilityCell, DoesNotCreditContactsThatAJoiningBodyReachesInItsFirstFrame) {
  constexpr int appear = 3;
  constexpr double speed = 100, g = speed / dt;  // m/s, m/s^2
  softbody::Scene scene = joined_by(joiner(appear, {0.7 + speed * dt, 0.01, 0.02}, {-speed, 0, 0}));
  scene.gravity = {0, -g, 0};
  EXPECT_NEAR(run(scene, "explicit-euler", appear + 1).energy, 1, 1e-3);
}

/// No body is there at the start. The bounds of energy and depth are known all the same.
TEST(StabilityCell, JudgesASceneWhoseBodiesAllJoinLater) {
  softbody::Scene falling = balls({joiner(2, {0, 40, 0})});
  falling.gravity = {0, -9.81, 0};
  EXPECT_NEAR(report::prepare({.scene = falling}, 1).limits.radius, 0.5, 0.01);
  const reference::StabilityFigures in_order = run(falling, "auto", 8);
  EXPECT_EQ(reference::failures(in_order), std::vector<std::string>{});
  EXPECT_GT(in_order.extent, 0) << "its springs tell how far it can be drawn";

  tests::set_solid(falling, {softbody::Ground{}});
  falling.bodies[0].position.y = 0.2;
  EXPECT_GT(run(falling, "auto", 4).transient, reference::stability_bounds.transient);

  softbody::Scene stiff = balls({joiner(2, {0, 0, 0}), joiner(2, {3, 0, 0}, {1, 0, 0})}, 1e8);
  EXPECT_GT(run(stiff, "explicit-euler", 20).energy, reference::stability_bounds.energy);
}

/// Explicit Euler gains energy in every frame. A heavy body that is still to join must not allow it more.
TEST(StabilityCell, AllowsNoMoreForBodiesThatAreStillToJoin) {
  softbody::Scene lone = balls({joiner(0, {0, 0, 0})}), awaiting = balls({joiner(0, {0, 0, 0}), joiner(5, {9, 0, 0})});
  for (softbody::Scene* scene : {&lone, &awaiting}) scene->gravity = {0, -98.1, 0};
  awaiting.materials.push_back(report::ball_material(1e3, 0.1));
  awaiting.materials[1][softbody::Material::mass] = 1000;
  awaiting.bodies[1].material = 1;
  const double gain = run(lone, "explicit-euler", 1).energy;
  EXPECT_GT(gain, 5 * reference::stability_bounds.energy);
  EXPECT_DOUBLE_EQ(run(awaiting, "explicit-euler", 1).energy, gain);
}

/// Bodies join in another order than that of the file.
TEST(StabilityCell, TellsBodiesApartByWhenTheyJoin) {
  softbody::Scene scene = balls({joiner(4, {9, -30, 0}), joiner(0, {0, 0, 0}), joiner(2, {0, 50, 0}, {0, 20, 0})});
  scene.gravity = {0, -9.81, 0};
  scene.materials.push_back(report::ball_material(1e3, 0.1));
  scene.materials[1][softbody::Material::mass] = 7;
  scene.bodies[0].material = 1;
  EXPECT_NEAR(run(scene, "auto", 8).energy, 0, 1e-3);
}

/// The hardest case of the report: frames of 1/30 s, in which a stiff ball flies 33 m.
TEST(StabilityCell, SimulatesAHitAt1000MetresASecondInFull) {
  const auto all = report::stability_cases();
  const auto hit = std::ranges::find(all, "impact-1000", &report::StabilityCase::key);
  ASSERT_NE(hit, all.end());
  for (const double stiffness : {1e6, 1e8}) {
    report::StabilityStart start = report::prepare(hit->make(stiffness), 0.5);
    start.not_judged = "only what needs no reference";
    const reference::StabilityFigures figures = report::run_cell(start, *softbody::find_integrator("auto"), dt);
    EXPECT_EQ(figures.refused, "");
    EXPECT_LE(figures.energy, reference::stability_bounds.energy) << stiffness << " N/m";
    EXPECT_EQ(figures.passed_through, 0) << stiffness << " N/m";
  }
}

}  // namespace THIS_FILE
}  // namespace app::test
