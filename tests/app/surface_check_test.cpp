#include "app/compare/surface_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "app/session/session.h"
#include "softbody/model/body_model.h"
#include "softbody/world/world.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

/// Returns a step of two spheres of radius 0.5 m at rest. distance: between their centres (m).
compare::StepSnapshot pair_apart(double distance) {
  softbody::Scene scene = touching_pair();
  scene.bodies[0].position = {-0.5 * distance, 3, 0.03};
  scene.bodies[1].position = {0.5 * distance, 3, 0};
  const softbody::World world(scene, {});
  compare::StepSnapshot step;
  step.id = 7;
  step.frame = 3;
  step.at.copy(world.positions());
  step.before = step.at;
  step.bodies = world.bodies();
  step.surfaces = {world.model(0).surface, world.model(1).surface};
  return step;
}

compare::SurfaceReport check(const compare::StepSnapshot& step) {
  Background<compare::SurfaceCheck> check(Runs::in_slices);
  check.offer(step);
  return *check.wait();
}

TEST(SurfaceCheck, ReportsAndMarksAllOverlapsAsMissedWithoutContacts) {
  const compare::StepSnapshot step = pair_apart(0.8);
  const compare::SurfaceReport report = check(step);
  EXPECT_EQ(report.id, 7u);
  EXPECT_EQ(report.frame, 3);
  EXPECT_EQ(report.failure, "");
  EXPECT_GT(report.penetrations, 0u);
  EXPECT_GT(report.figures.deepest, 0.1);
  EXPECT_LT(report.figures.deepest, 0.2);  // they overlap by 0.2 m
  EXPECT_EQ(report.missed_penetrations, report.penetrations);
  EXPECT_EQ(report.missed_piercings, report.figures.piercings);
  EXPECT_EQ(report.missed_pairs, 1u);
  const auto piercings = static_cast<std::size_t>(std::ranges::count_if(report.marks, &compare::SurfaceMark::piercing));
  EXPECT_EQ(piercings, report.missed_piercings);
  EXPECT_EQ(report.marks.size(), report.missed_penetrations + report.missed_piercings);
  double deepest = 0;
  for (const compare::SurfaceMark& mark : report.marks) {
    if (mark.piercing) {
      EXPECT_LT(std::abs(step.at.x[mark.vertex] + mark.offset.x), 0.1f);  // between the two spheres' poles
    } else {
      deepest = std::max(deepest, static_cast<double>(glm::length(mark.offset)));
    }
  }
  EXPECT_NEAR(deepest, report.figures.deepest, 1e-6);
}

TEST(SurfaceCheck, ReportsNothingMissedIfAllVerticesAreInContact) {
  compare::StepSnapshot step = pair_apart(0.8);
  const collide::Index half = step.bodies.first[1];
  for (collide::Index a = 0; a < half; ++a)
    for (collide::Index b = half; b < step.bodies.vertex_count(); ++b) step.contacts.push_back({a, b});
  const compare::SurfaceReport report = check(step);
  EXPECT_GT(report.penetrations, 0u);
  EXPECT_EQ(report.missed_penetrations + report.missed_piercings + report.missed_pairs, 0u);
  EXPECT_TRUE(report.marks.empty());
}

TEST(SurfaceCheck, CountsTheCrossingsOfTheStep) {
  compare::StepSnapshot step = pair_apart(0.8);
  EXPECT_EQ(check(step).figures.crossed_vertices, 0u);
  step.before = pair_apart(1.5).at;
  const collide::oracle::SurfaceFigures passed = check(step).figures;
  EXPECT_EQ(passed.crossed_vertices, passed.penetrating_vertices);
  for (auto* some : {&step.before.x, &step.before.y, &step.before.z}) some->resize(step.bodies.first[1]);
  const collide::oracle::SurfaceFigures arrived = check(step).figures;  // the second body has just been added
  EXPECT_GT(arrived.crossed_vertices, 0u);
  step.before = {};
  EXPECT_EQ(check(step).figures.crossed_vertices, 0u);  // both have just been added
}

TEST(SurfaceCheck, EndsBetweenItsPartsWhenCancelled) {
  Background<compare::SurfaceCheck> check(Runs::in_slices);
  check.offer(pair_apart(0.8));
  EXPECT_FALSE(check.take({}));
  check.cancel();
  const auto report = check.take({});
  ASSERT_TRUE(report);
  EXPECT_EQ(report->penetrations, 0u) << "it was not finished";
}

TEST(SurfaceCheck, ReportsWhyThereAreNoFigures) {
  compare::StepSnapshot step = pair_apart(0.8);
  step.surfaces.pop_back();
  EXPECT_NE(check(step).failure, "");
}

/// Advances a paused session until the surfaces of its present state are checked.
bool wait_for_check(Session& session) {
  return wait_until([&] {
    session.advance(tick);
    return session.surfaces.report().id == session.simulation.revision();
  });
}

TEST(SurfaceMonitor, ChecksEachStateOnRequest) {
  softbody::Scene scene = touching_pair();
  scene.bodies[0].position.x = -0.3;  // inside the other one
  Session session(scene, {}, 1);
  session.simulation.clock.paused = true;
  session.advance(tick);
  EXPECT_EQ(session.surfaces.report().id, 0u);
  session.surfaces.on = true;
  ASSERT_TRUE(wait_for_check(session));
  EXPECT_EQ(session.surfaces.report().figures.overlapping_pairs, 1u);
  EXPECT_EQ(session.surfaces.sums().steps, 0);  // nothing has moved yet
  session.simulation.clock.single_step();
  session.advance(tick);
  ASSERT_TRUE(wait_for_check(session));
  EXPECT_EQ(session.surfaces.report().frame, 1);
  const session::CrossingSums sums = session.surfaces.sums();
  EXPECT_EQ(sums.steps, 1);
  session.settings.set_method("grid-hash");  // the same step once more
  ASSERT_TRUE(wait_for_check(session));
  EXPECT_EQ(session.surfaces.sums().steps, 1);
  EXPECT_EQ(session.surfaces.sums().vertices, sums.vertices);
  session.surfaces.on = false;
  session.advance(tick);
  EXPECT_EQ(session.surfaces.report().id, 0u);
  EXPECT_EQ(session.surfaces.sums().steps, 0);
}

}  // namespace THIS_FILE
}  // namespace app
