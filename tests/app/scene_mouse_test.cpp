// Picking with the mouse in the scene, and what its clicks and drags do.

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "app/ui/state/ui_state.h"
#include "app/window/scene_mouse.h"
#include "softbody/model/body_model.h"
#include "tests/app/recorded_bodies.h"
#include "tests/app/scenes.h"
#include "tests/support/world_test_access.h"

namespace app {
namespace THIS_FILE {

constexpr glm::ivec2 size{800, 600};

engine::Camera camera_at(const glm::vec3& target, float distance) {
  engine::Camera camera;
  camera.fit(target, distance / 2, size);
  camera.set_orbit({target, distance, 0.3f, 0.2f});
  return camera;
}

glm::vec2 pixel_of(const engine::Camera& camera, const glm::vec3& point) {
  return glm::vec2(*camera.project(point, size));
}

/// The first triangle that a ray hits.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  softbody::BodyId body = 0;
  softbody::Triangle corners{};
};
/// Tests all triangles, by Cramer's rule in double.
Nearest brute_force(const engine::Ray& ray, const softbody::BodiesInMotion& world) {
  Nearest nearest;
  const collide::Frame f = world.positions();
  for (softbody::BodyId body = 0; body < world.bodies().count(); ++body)
    for (const softbody::Triangle& t : world.model(body).mesh.triangles) {
      const auto at = [&](std::size_t k) {
        const std::size_t i = world.bodies().first[body] + t[k];
        return glm::dvec3(f.x[i], f.y[i], f.z[i]);
      };
      const glm::dmat3 columns(at(1) - at(0), at(2) - at(0), -glm::dvec3(ray.direction));
      const glm::dvec3 solution = glm::inverse(columns) * (glm::dvec3(ray.origin) - at(0));
      const bool inside = solution.x >= 0 && solution.y >= 0 && solution.x + solution.y <= 1 && solution.z > 0;
      if (inside && solution.z < nearest.distance) nearest = {solution.z, body, t};
    }
  return nearest;
}

TEST(Pick, FindsWhatBruteForceFinds) {
  softbody::World world(without_solids(), {});
  const engine::Camera camera = camera_at({0, 3, 0}, 4);
  std::mt19937 random(1);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto share = [&] { return static_cast<float>(random() % 10000) / 10000.0f; };
    const engine::Ray ray = camera.pick_ray({share() * size.x, share() * size.y}, size);
    const auto found = render::pick(ray, world, {.now = world.positions()});
    const Nearest expected = brute_force(ray, world);
    ASSERT_EQ(found.has_value(), std::isfinite(expected.distance));
    if (!found) continue;
    ++hits;
    EXPECT_EQ(found->body, expected.body);
    EXPECT_NEAR(found->distance, expected.distance, 1e-4);
    EXPECT_NEAR(found->weights.x + found->weights.y + found->weights.z, 1, 1e-6);
    const collide::Frame f = world.positions();
    glm::vec3 point(0.0f);
    for (int k = 0; k < 3; ++k) {
      const std::size_t v = world.bodies().first[found->body] + found->corners[static_cast<std::size_t>(k)];
      point += found->weights[k] * glm::vec3(f.x[v], f.y[v], f.z[v]);
    }
    EXPECT_LT(glm::distance(point, found->point), 1e-4f);
  }
  EXPECT_GT(hits, 100);
}

TEST(Pick, IgnoresBodiesBehindASolid) {
  const engine::Ray ray{{-0.51f, 3.03f, 10}, {0, 0, -1}};
  softbody::Scene scene = without_solids();
  for (const double z : {5.0, -5.0}) {
    scene.solids = {{softbody::SolidSphere{.centre = {-0.5, 3, z}, .radius = 1}}};
    const softbody::World world(scene, {});
    EXPECT_EQ(render::pick(ray, world, {.now = world.positions()}).has_value(), z < 0);
  }
}

TEST(Pick, HitsBodiesWhereTheyAreDrawn) {
  softbody::World world(without_solids(), {});
  compare::Positions before;
  before.copy(world.positions());
  for (float& y : before.y) y += 2;
  const engine::Ray ray{{-0.51f, 4.03f, 10}, {0, 0, -1}};
  EXPECT_FALSE(render::pick(ray, world, {.now = world.positions()}));
  EXPECT_TRUE(render::pick(ray, world, {world.positions(), before.x, before.y, before.z, 0.5f}));
}

class SceneMouseTest : public testing::Test {
 protected:
  explicit SceneMouseTest(const files::Opened& opened = without_solids()) : session(opened, {}, 1) {}
  void frame(int times = 1) {
    for (int i = 0; i < times; ++i) {
      session.advance(tick);
      for (const ui::WindowTask task : carry_out(mouse.update(input, session, ui, camera, size), session, ui))
        if (task == ui::WindowTask::show_selected_body)
          window::focus_on(*session.bodies.selected(), session, camera, size);
      camera.advance(tick);
      input.moved = {};
      input.double_click = false;
    }
  }
  void move(const glm::vec2& to) {
    input.moved = to - input.at;
    input.at = to;
    frame();
  }
  void button(std::size_t which, bool down) {
    input.down[which] = down;
    frame();
  }
  /// Moves the mouse with a button pressed, and waits for the camera.
  void drag(const glm::vec2& way, std::size_t which = 0) {
    button(which, true);
    move(input.at + way);
    button(which, false);
    camera.finish_glide();
  }
  glm::vec2 body_pixel(softbody::BodyId id) { return pixel_of(camera, glm::vec3(centre(session.world(), id))); }

  Session session;
  ui::UiState ui;
  engine::Camera camera = camera_at({0, 3, 0}, 8);
  window::SceneMouse mouse;
  window::MouseInput input;
};

/// Between two frames the camera follows the mouse, and the next frame adds only the rest of the way.
TEST_F(SceneMouseTest, ContinuesToOrbitBetweenFrames) {
  const auto orbit_after_drag = [&](bool between) {
    camera = camera_at({0, 3, 0}, 8);
    input.at = {5, 5};  // on the background
    button(0, true);
    if (between) {
      const engine::Orbit before = camera.orbit();
      mouse.orbit_between_pictures({60, 20}, camera, size);
      camera.finish_glide();
      EXPECT_NE(camera.orbit().azimuth, before.azimuth);
    }
    move({100, 40});
    camera.finish_glide();
    button(0, false);
    return camera.orbit();
  };
  const engine::Orbit whole = orbit_after_drag(false), parts = orbit_after_drag(true);
  EXPECT_NEAR(whole.azimuth, parts.azimuth, 1e-5);
  EXPECT_NEAR(whole.elevation, parts.elevation, 1e-5);
  const engine::Orbit before = camera.orbit();
  mouse.orbit_between_pictures({400, 300}, camera, size);  // there is no drag
  camera.finish_glide();
  EXPECT_EQ(camera.orbit().azimuth, before.azimuth);
}

TEST_F(SceneMouseTest, GrabsPullsAndThrows) {
  move(body_pixel(1));
  EXPECT_TRUE(mouse.can_drag());
  EXPECT_FALSE(session.bodies.selected());
  button(0, true);
  const std::uint64_t before = session.simulated()->state_hash();
  ASSERT_TRUE(session.simulated()->grabbed());
  EXPECT_EQ(session.simulated()->grabbed()->body, 1u);
  EXPECT_EQ(session.bodies.selected(), 1u);
  const engine::Orbit orbit = camera.orbit();
  const glm::vec2 target = input.at + glm::vec2(150, -60);
  for (int i = 1; i <= 30; ++i) move(input.at + (target - input.at) * 0.2f);
  frame(90);
  const glm::vec3 point(softbody::grabbed_point(*session.simulated()));
  EXPECT_LT(glm::distance(pixel_of(camera, point), target), 5);
  EXPECT_LT(glm::distance(body_pixel(1), target), 80);  // the body hangs from the mouse
  EXPECT_EQ(camera.orbit().azimuth, orbit.azimuth);
  const glm::dvec3 held(softbody::grabbed_point(*session.simulated()));
  EXPECT_NEAR(glm::distance(glm::dvec3(camera.eye()), held),
              glm::distance(glm::dvec3(camera.eye()), centre(session.world(), 0)), 1);
  for (int i = 0; i < 10; ++i) move(input.at - glm::vec2(25, 0));
  button(0, false);
  EXPECT_FALSE(session.simulated()->grabbed());
  const glm::vec2 at_release = body_pixel(1);
  frame(10);
  EXPECT_LT(body_pixel(1).x, at_release.x - 10);  // the body flies on
  EXPECT_EQ(session.bodies.selected(), 1u);
  undo(session.simulation);
  EXPECT_EQ(session.simulated()->state_hash(), before);
  EXPECT_FALSE(can_undo(session.simulation)) << "it was one change";
}

TEST_F(SceneMouseTest, ChangesNothingByAClickOnABody) {
  session.bodies.drop();
  undo(session.simulation);
  ASSERT_TRUE(can_redo(session.simulation));
  move(body_pixel(1));
  drag({2, 1});
  EXPECT_EQ(session.bodies.selected(), 1u);
  EXPECT_FALSE(can_undo(session.simulation));
  EXPECT_TRUE(can_redo(session.simulation));
}

softbody::Scene with_solids() {
  softbody::Scene scene = without_solids();
  scene.solids = {{softbody::SolidSphere{.centre = {-1.5, 1.5, 0}, .radius = 0.4}},
                  {softbody::SolidBox{.centre = {0, 1.5, 0}, .half_size = glm::dvec3(0.3)}},
                  {softbody::SolidCapsule{.from = {1.5, 1.4, 0}, .to = {1.5, 1.7, 0}, .radius = 0.2}},
                  {softbody::Ground{}}};
  return scene;
}

/// The bodies of without_solids(), and below them a sphere, a box and a capsule over the ground.
class SolidDrag : public SceneMouseTest {
 protected:
  SolidDrag() : SceneMouseTest(with_solids()) {}
  glm::dvec3 place(std::size_t index) const {
    const softbody::Scene& scene = session.world().scene();
    return index == 0   ? shape_of<softbody::SolidSphere>(scene).centre
           : index == 1 ? shape_of<softbody::SolidBox>(scene).centre
                        : shape_of<softbody::SolidCapsule>(scene).from;
  }
  const std::array<glm::vec3, 3> middles{glm::vec3(-1.5, 1.5, 0), {0, 1.5, 0}, {1.5, 1.55, 0}};
};

TEST_F(SolidDrag, MovesEachKindOfSolidInThePlaneThatFacesTheCamera) {
  const glm::vec3 ahead = glm::normalize(camera.orbit().target - camera.eye());
  for (std::size_t i = 0; i < middles.size(); ++i) {
    session.simulation.clock.paused = i == 1;
    const glm::dvec3 before = place(i);
    const auto others = session.world().scene().solids;
    move(pixel_of(camera, middles[i]));
    EXPECT_TRUE(mouse.can_drag());
    button(0, true);
    EXPECT_EQ(std::exchange(ui.solid, std::nullopt), i);
    const engine::Orbit orbit = camera.orbit();
    const glm::vec2 way(30, -20);
    for (int step = 0; step < 10; ++step) move(input.at + 0.1f * way);
    const glm::dvec3 there = place(i);
    EXPECT_GT(glm::distance(there, before), 0.1);
    EXPECT_NEAR(glm::dot(there - before, glm::dvec3(ahead)), 0, 1e-5);
    EXPECT_LT(
        glm::distance(pixel_of(camera, middles[i] + glm::vec3(there - before)), pixel_of(camera, middles[i]) + way), 2);
    frame(3);
    EXPECT_EQ(place(i), there) << "the mouse rests";
    button(0, false);
    move(input.at + way);
    EXPECT_EQ(place(i), there);
    EXPECT_EQ(camera.orbit().azimuth, orbit.azimuth);
    for (std::size_t k = 0; k < others.size(); ++k)
      EXPECT_EQ(session.world().scene().solids[k] == others[k], k != i) << k;
    undo(session.simulation);
    EXPECT_EQ(place(i), before);
    EXPECT_FALSE(can_undo(session.simulation)) << "one step a drag";
  }
}

class RecordedSolid : public SceneMouseTest {
 protected:
  static files::Opened scene() {
    files::Opened balls = opened(std::make_shared<RecordedBalls>(6));
    balls.scene.solids = {{softbody::SolidSphere{.centre = {0, 5, 0}, .radius = 1}}};
    return balls;
  }
  RecordedSolid() : SceneMouseTest(scene()) {}
};

TEST_F(RecordedSolid, StaysWhereTheBodiesHaveMetIt) {
  camera = camera_at({0, 5, 0}, 8);
  move(pixel_of(camera, {0, 5, 0}));
  EXPECT_FALSE(mouse.can_drag());
  drag({40, 20});
  EXPECT_EQ(session.world().scene().solids, scene().scene.solids);
}

TEST_F(SolidDrag, OpensTheSectionOfTheSolidAndChangesNothingByAClick) {
  session.bodies.select(0);
  move(pixel_of(camera, middles[0]));
  drag({2, 1});
  EXPECT_EQ(ui.solid, 0u);
  EXPECT_TRUE(ui.sections.at("Solids") && ui.sections.at("More"));
  EXPECT_EQ(place(0), glm::dvec3(-1.5, 1.5, 0));
  EXPECT_FALSE(can_undo(session.simulation));
  EXPECT_FALSE(session.bodies.selected()) << "as a click beside the bodies";
}

TEST_F(SolidDrag, LeavesTheGroundAndSolidsThatAreSwitchedOff) {
  const auto expect_orbit = [&](const glm::vec3& at) {
    move(pixel_of(camera, at));
    EXPECT_FALSE(mouse.can_drag());
    const std::vector<softbody::Solid> before = session.world().scene().solids;
    const bool could_undo = can_undo(session.simulation);
    const float azimuth = camera.orbit().azimuth;
    drag({60, 0});
    EXPECT_NE(camera.orbit().azimuth, azimuth);
    EXPECT_TRUE(session.world().scene().solids == before);
    EXPECT_EQ(can_undo(session.simulation), could_undo);
    camera = camera_at({0, 3, 0}, 8);
  };
  expect_orbit({0, 0, 1});
  softbody::Solid solid = session.world().scene().solids[0];
  solid.enabled = false;
  session.settings.set_solid(0, solid);
  expect_orbit(middles[0]);
}

TEST_F(SolidDrag, TakesWhatIsInFront) {
  move(body_pixel(1));
  softbody::Solid sphere = session.world().scene().solids[0];
  const glm::dvec3 eye(camera.eye()), body = centre(session.world(), 1);
  const auto press_with_sphere_at = [&](double share) {
    sphere.shape = softbody::SolidSphere{.centre = eye + share * (body - eye), .radius = 0.3};
    session.settings.set_solid(0, sphere);
    ui.solid.reset();
    button(0, true);
    const bool solid = ui.solid.has_value();
    button(0, false);
    return solid;
  };
  EXPECT_FALSE(press_with_sphere_at(1.3));
  EXPECT_TRUE(press_with_sphere_at(0.7));
}

TEST_F(SolidDrag, EndsWhenAnotherWorldComes) {
  move(pixel_of(camera, middles[0]));
  button(0, true);
  move(input.at + glm::vec2(40, 0));
  undo(session.simulation);
  move(input.at + glm::vec2(40, 0));
  EXPECT_EQ(place(0), glm::dvec3(-1.5, 1.5, 0));
  button(0, false);
  EXPECT_FALSE(can_undo(session.simulation));
}

TEST_F(SceneMouseTest, OrbitsByADragOfTheBackgroundAndDeselectsByAClick) {
  session.bodies.select(0);
  move({5, 5});
  EXPECT_FALSE(mouse.can_drag());
  const float azimuth = camera.orbit().azimuth;
  drag({200, 0});
  EXPECT_GT(std::abs(camera.orbit().azimuth - azimuth), 0.1f);
  EXPECT_EQ(session.bodies.selected(), 0u);  // that was a drag
  move({5, 5});
  drag({0, 0});
  EXPECT_FALSE(session.bodies.selected());
}

/// In one slow frame, the way to the place of the press is no drag, but the way from there to the release is one.
TEST_F(SceneMouseTest, IgnoresTheWayBeforeAPress) {
  const engine::Orbit before = camera.orbit();
  const auto jump = [&](const glm::vec2& to, std::size_t which, bool down) {
    input.moved = to - input.at;
    input.at = to;
    button(which, down);
    camera.finish_glide();
  };
  session.bodies.select(0);
  for (const std::size_t which : {0u, 1u}) {
    jump({400, 5}, which, true);
    jump({400, 5}, which, false);
    jump({5, 5}, 2, false);
    EXPECT_EQ(camera.orbit().azimuth, before.azimuth);
    EXPECT_EQ(camera.orbit().target, before.target);
  }
  EXPECT_FALSE(session.bodies.selected()) << "that was a click on the background";
  session.simulation.clock.paused = true;
  jump(body_pixel(1), 0, true);
  jump(input.at, 0, false);
  EXPECT_EQ(session.bodies.selected(), 1u);
  EXPECT_EQ(camera.orbit().azimuth, before.azimuth);
  jump({5, 5}, 0, true);
  jump({205, 5}, 0, false);
  EXPECT_GT(std::abs(camera.orbit().azimuth - before.azimuth), 0.1f);
  EXPECT_EQ(session.bodies.selected(), 1u) << "that was a drag";
}

TEST_F(SceneMouseTest, SelectsAndOrbitsWhilePaused) {
  session.simulation.clock.paused = true;
  move(body_pixel(0));
  const float azimuth = camera.orbit().azimuth;
  button(0, true);
  EXPECT_EQ(session.bodies.selected(), 0u);
  EXPECT_FALSE(session.simulated()->grabbed());
  move(input.at + glm::vec2(100, 0));
  button(0, false);
  camera.finish_glide();
  EXPECT_GT(std::abs(camera.orbit().azimuth - azimuth), 0.1f);
  EXPECT_EQ(session.bodies.selected(), 0u);
}

TEST_F(SceneMouseTest, FocusesOnADoubleClickedBody) {
  session.simulation.clock.paused = true;
  move(body_pixel(1));
  input.double_click = true;
  drag({0, 0});
  EXPECT_LT(glm::distance(glm::dvec3(camera.orbit().target), centre(session.world(), 1)), 0.05);
  EXPECT_LT(camera.orbit().distance, 5);
  EXPECT_FALSE(session.simulated()->grabbed());
}

TEST_F(SceneMouseTest, PansAndOrbitsByTheOtherButtonsAndIgnoresThePanelsMouse) {
  move(body_pixel(0));
  const engine::Orbit first = camera.orbit();
  drag({50, 0}, 1);
  EXPECT_GT(glm::distance(camera.orbit().target, first.target), 0.05f);
  EXPECT_EQ(camera.orbit().azimuth, first.azimuth);
  move(body_pixel(0));
  drag({50, 0}, 2);
  EXPECT_NE(camera.orbit().azimuth, first.azimuth);
  EXPECT_FALSE(session.bodies.selected()) << "the middle button leaves bodies alone";
  const engine::Orbit before = camera.orbit();
  input.over_scene = false;
  input.wheel = 3;
  move(body_pixel(0));
  drag({50, 0});
  EXPECT_EQ(camera.orbit().distance, before.distance);
  EXPECT_EQ(camera.orbit().azimuth, before.azimuth);
  EXPECT_FALSE(session.bodies.selected());
}

TEST_F(SceneMouseTest, AimsAtTheMouseOrAtTheMiddle) {
  move({200, 150});
  EXPECT_EQ(mouse.ray(camera, size).direction, camera.pick_ray({200, 150}, size).direction);
  input.over_scene = false;
  frame();
  EXPECT_EQ(mouse.ray(camera, size).direction, camera.pick_ray({400, 300}, size).direction);
}

TEST_F(SceneMouseTest, NamesTheHalfThatItAimsInto) {
  session.simulation.set_beside(compare::usual_second(session.world(), {}));
  move({600, 300});
  EXPECT_EQ(mouse.half(), session::Half::second);
  move({200, 300});
  EXPECT_EQ(mouse.half(), session::Half::first);
  ui.beside_as_ghost = true;
  move({600, 300});
  EXPECT_EQ(mouse.half(), session::Half::first);
}

}  // namespace THIS_FILE
}  // namespace app
