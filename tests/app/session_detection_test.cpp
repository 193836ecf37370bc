#include "app/session/session.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <chrono>
#include <thread>

#include "tests/app/scenes.h"

namespace app {
namespace {

using namespace std::chrono_literals;

Session make_session() { return Session(touching_pair(), {}, 1); }

TEST(Session, RefusesSettingsWithAProblem) {
  Session session = make_session();
  collide::Settings bad = session.world().collision();
  bad.tolerance = -1;
  session.set_collision(bad, true);
  EXPECT_FALSE(session.notice().empty());
  EXPECT_EQ(session.world().collision().tolerance, 0.1f);
  session.set_collision(session.world().collision(), true);
  EXPECT_TRUE(session.notice().empty());
}

TEST(Session, ShowsNewContactsWhilePausedAfterAChange) {
  Session session = make_session();
  session.paused = true;
  const auto before = session.world().detection().contacts.size();
  const auto revision = session.revision();
  collide::Settings settings = session.world().collision();
  settings.tolerance = 0.2f;
  session.set_collision(settings, true);
  EXPECT_GT(session.world().detection().contacts.size(), before);
  EXPECT_NE(session.revision(), revision);
}

TEST(Session, GoesThroughAllMethods) {
  Session session = make_session();
  const std::string first(session.world().method().key);
  for (std::size_t i = 0; i < collide::method_table().size(); ++i) {
    session.next_method();
    session.advance(tick);
    EXPECT_TRUE(session.notice().empty());
  }
  EXPECT_EQ(session.world().method().key, first);
  session.set_method("no-such-method");
  EXPECT_EQ(session.world().method().key, first);
}

TEST(Session, LeavesOutAMethodThatWouldTakeTooLong) {
  softbody::Scene scene = touching_pair();
  scene.bodies.pop_back();
  scene.bodies[0].mesh.subdivisions = 4;
  for (int i = 1; i < 18; ++i) {  // 46,116 vertices are more than a billion pairs
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies.back().position.x += 2.0 * i;
  }
  Session session(scene, {}, 1);
  const std::string first(session.world().method().key);
  session.set_method("brute-force");
  EXPECT_EQ(session.world().method().key, first);
  EXPECT_NE(session.notice().find("too long to drive"), std::string::npos) << session.notice();
  for (std::size_t i = 0; i < collide::method_table().size(); ++i) {
    session.next_method();
    EXPECT_NE(session.world().method().key, "brute-force");
  }
}

TEST(Session, KeepsTheSelectedBucketInsideTheTable) {
  Session session = make_session();
  session.select_bucket(900);
  EXPECT_EQ(session.selected_bucket(), 900u);
  session.select_bucket(1001);
  EXPECT_FALSE(session.selected_bucket());
  session.select_bucket(900);
  collide::Settings settings = session.world().collision();
  settings.buckets = 101;
  session.set_collision(settings, true);
  EXPECT_FALSE(session.selected_bucket());
}

TEST(Session, HandsOutTheInnerPictureOfTheDrivingMethodOrElseThePapers) {
  Session session = make_session();
  for (const collide::Method& method : collide::method_table()) {
    session.set_method(method.key);
    session.advance(tick);
    const std::string_view shown = method.uses_hash ? method.key : collide::paper_method;
    EXPECT_EQ(session.shown_method().key, shown);
    const auto detector = session.shown_method().make();
    collide::Workers workers(1);
    collide::Result result;
    detector->detect(session.world().positions(), session.world().collision(), workers, result);
    EXPECT_EQ(session.debug().loads, detector->debug().loads) << method.key;
    EXPECT_EQ(session.debug().box_bucket, detector->debug().box_bucket) << method.key;
  }
}

TEST(Session, TheAreasSearchedHoldEveryContactBetweenBodies) {
  Session session = make_session();
  session.advance(tick);
  const auto areas = session.areas();
  const collide::Frame frame = session.world().positions();
  const auto body = session.world().vertex_body();
  std::size_t between = 0;
  for (const collide::Contact& contact : session.world().detection().contacts) {
    if (body[contact.a] == body[contact.b]) continue;
    ++between;
    const glm::vec3 middle = 0.5f * (glm::vec3(frame.x[contact.a], frame.y[contact.a], frame.z[contact.a]) +
                                     glm::vec3(frame.x[contact.b], frame.y[contact.b], frame.z[contact.b]));
    EXPECT_TRUE(std::ranges::any_of(areas, [&](const auto& area) {
      return glm::all(glm::lessThan(area.lo, middle + 1e-5f)) && glm::all(glm::lessThan(middle - 1e-5f, area.hi));
    }));
  }
  EXPECT_GT(between, 0u);
}

/// Lets a paused session run until its recall is measured for the present state.
bool wait_for_recall(Session& session) {
  for (const auto end = std::chrono::steady_clock::now() + 60s; std::chrono::steady_clock::now() < end;) {
    session.advance(tick);
    if (session.comparison().id == session.revision()) return true;
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

TEST(Session, MeasuresTheRecallOfAPausedWorldAfterEveryChange) {
  Session session = make_session();
  session.paused = true;
  EXPECT_EQ(session.driver_row(), nullptr);
  ASSERT_TRUE(wait_for_recall(session));
  EXPECT_EQ(session.driver_row()->recall, 1.0);
  session.set_method("multi-level-sb");
  EXPECT_EQ(session.driver_row(), nullptr);  // what is known of another method says nothing of this one
  collide::Settings settings = session.world().collision();
  settings.cell_size = glm::vec3(0.13f);
  settings.buckets = 1'000'003;
  session.set_collision(settings, false);
  ASSERT_TRUE(wait_for_recall(session));
  EXPECT_LT(session.driver_row()->recall, 1.0);
  EXPECT_EQ(session.missed(), &session.driver_row()->missed);
  session.reset();
  EXPECT_EQ(session.comparison().id, 0u);
  EXPECT_EQ(session.missed(), nullptr);
}

TEST(Session, ComparesAllMethodsAgainAndAgainWhileAskedTo) {
  Session session = make_session();
  session.paused = true;
  session.compare.on = true;
  const std::size_t method = method_index("grid-hash");
  for (const auto end = std::chrono::steady_clock::now() + 60s;
       session.history().method_ms[method].size() < 3 && std::chrono::steady_clock::now() < end;) {
    session.advance(tick);
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_GE(session.history().method_ms[method].size(), 3u);
  EXPECT_GT(session.history().method_ms[method].median(15), 0.0f);
  collide::Settings settings = session.world().collision();
  settings.levels = 5;
  session.set_collision(settings, true);
  EXPECT_EQ(session.history().method_ms[method].size(), 0u);  // other settings, other times
}

/// The first side's closest point, or the second's.
glm::dvec3 closest_point(const softbody::SurfaceContactPoint& touch, const collide::Frame& frame, bool second) {
  glm::dvec3 point(0.0);
  double sum = 0;
  for (std::size_t k = 0; k < touch.vertex.size(); ++k) {
    const double weight = second ? -touch.weight[k] : touch.weight[k];
    const collide::Index v = touch.vertex[k];
    if (weight > 0) point += weight * glm::dvec3(frame.x[v], frame.y[v], frame.z[v]);
    if (weight > 0) sum += weight;
  }
  EXPECT_NEAR(sum, 1, 1e-5);
  return point;
}

TEST(Session, TouchesAreTheClosestPointsOfTheTwoBodies) {
  softbody::Scene scene = touching_pair();
  scene.contact_surface = softbody::ContactSurface::surfaces;
  scene.bodies[0].velocity = {1, 0, 0};
  Session session(scene, {}, 1);
  for (int i = 0; i < 60 && session.touches().empty(); ++i) session.advance(tick);
  ASSERT_FALSE(session.touches().empty());
  const collide::Frame frame = session.world().positions();
  const auto body = session.world().vertex_body();
  for (const softbody::SurfaceContactPoint& touch : session.touches()) {
    EXPECT_NE(touch.a, touch.b);
    EXPECT_EQ(body[touch.vertex[0]], touch.a);
    EXPECT_EQ(body[touch.vertex[3]], touch.b);
    const glm::dvec3 apart = closest_point(touch, frame, false) - closest_point(touch, frame, true);
    EXPECT_LT(glm::length(apart), 0.02);
    EXPECT_GT(glm::dot(apart, glm::dvec3(touch.normal)), 0);
    EXPECT_GT((touch.a == 0 ? -1 : 1) * touch.normal.x, 0.5f);  // body 0 is at the left
  }
  session.set_contact_surface(softbody::ContactSurface::vertices);
  EXPECT_TRUE(session.touches().empty());
}
}  // namespace
}  // namespace app
