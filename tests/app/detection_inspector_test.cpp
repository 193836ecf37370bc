#include "app/session/detection_inspector.h"

#include <gtest/gtest.h>

#include <glm/vector_relational.hpp>

#include "app/session/setting_controls.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

TEST(DetectionInspector, ShowsTheGeometryOfTheDrivingMethodOrElseThePapers) {
  session::Simulation simulation(touching_pair(), 1);
  session::SettingControls controls(simulation);
  session::DetectionInspector inspector(simulation);
  for (const collide::Method& method : collide::method_table()) {
    controls.set_method(method.key);
    simulation.advance(tick);
    const std::string_view shown = method.uses_hash ? method.key : collide::paper_method;
    EXPECT_EQ(inspector.shown_method().key, shown);
    const auto detector = inspector.shown_method().make();
    collide::Workers workers(1);
    collide::Result result;
    detector->detect(simulation.world().positions(), simulation.world().collision(), workers, result);
    EXPECT_EQ(inspector.shown_geometry().loads, detector->debug().loads) << method.key;
    EXPECT_EQ(inspector.shown_geometry().box_bucket, detector->debug().box_bucket) << method.key;
  }
}

TEST(DetectionInspector, FindsEveryContactBetweenBodiesInTheSearchAreas) {
  session::Simulation simulation(touching_pair(), 1);
  session::DetectionInspector inspector(simulation);
  simulation.advance(tick);
  const auto areas = inspector.search_areas();
  const collide::Frame frame = simulation.world().positions();
  const auto body = [&](collide::Index vertex) { return simulation.world().bodies().body_of(vertex); };
  std::size_t between = 0;
  for (const collide::Contact& contact : simulation.world().detection().contacts) {
    if (body(contact.a) == body(contact.b)) continue;
    ++between;
    const glm::vec3 middle = 0.5f * (glm::vec3(frame.x[contact.a], frame.y[contact.a], frame.z[contact.a]) +
                                     glm::vec3(frame.x[contact.b], frame.y[contact.b], frame.z[contact.b]));
    EXPECT_TRUE(std::ranges::any_of(areas, [&](const auto& area) {
      return glm::all(glm::lessThan(area.lo, middle + 1e-5f)) && glm::all(glm::lessThan(middle - 1e-5f, area.hi));
    }));
  }
  EXPECT_GT(between, 0u);
}

TEST(DetectionInspector, HasTheSurfaceContactsOfThePresentWorld) {
  softbody::Scene scene = touching_pair();
  scene.contact_surface = softbody::ContactSurface::surfaces;
  scene.bodies[0].velocity = {1, 0, 0};
  session::Simulation simulation(scene, 1);
  session::DetectionInspector inspector(simulation);
  for (int i = 0; i < 60 && inspector.surface_contacts().empty(); ++i) simulation.advance(tick);
  ASSERT_FALSE(inspector.surface_contacts().empty());
  EXPECT_EQ(inspector.surface_contacts().size(), simulation.simulated()->surface_contacts().size());
  simulation.change_scene("Contact",
                          [](softbody::Scene& s) { s.contact_surface = softbody::ContactSurface::vertices; });
  EXPECT_TRUE(inspector.surface_contacts().empty());
}

}  // namespace THIS_FILE
}  // namespace app
