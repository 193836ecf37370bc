#include "app/ui/views/coverage_light.h"

#include "app/ui/panel/panel.h"
#include "tests/app/panel_rig.h"

namespace app {
namespace THIS_FILE {

TEST(CoverageLight, NamesTheAxesAlongWhichABoxExceedsACell) {
  collide::DebugGeometry paper;
  paper.boxes = {{{0, 0, 0}, {0.5f, 0.25f, 0.75f}, 0}, {{1, 1, 1}, {1.25f, 1.5f, 1.25f}, 1}};
  EXPECT_NE(ui::box_against_cell(paper, glm::vec3(0.75f)).find("Every box fits"), std::string::npos);
  const std::string beyond = ui::box_against_cell(paper, {0.4f, 0.6f, 0.7f});
  EXPECT_NE(beyond.find("Along x, z a box is larger"), std::string::npos) << beyond;
  EXPECT_NE(beyond.find("0.500 x 0.500 x 0.750 m"), std::string::npos) << beyond;
  EXPECT_NE(ui::box_against_cell({}, glm::vec3(1)).find("pause"), std::string::npos);
}

TEST(CoverageLight, ExplainsItselfAtAClick) {
  PanelRig rig;
  EXPECT_FALSE(rig.recorder.find("Coverage explained"));
  rig.click("Coverage");
  EXPECT_TRUE(rig.recorder.find("Coverage explained"));
  rig.click("Coverage");
  EXPECT_FALSE(rig.recorder.find("Coverage explained"));
}

TEST(CoverageLight, FitsOneLineWithEveryMethodInANarrowWindow) {
  PanelRig rig;
  rig.resize(static_cast<int>(ui::panel_width) + 424, 600);
  for (const collide::Method& method : collide::method_table())
    for (const float cell : {0.2f, 2.0f}) {
      rig.session.settings.set_method(method.key);
      rig.change([&](softbody::Scene& scene) { scene.collision.cell_size = glm::vec3(cell); });
      ASSERT_TRUE(rig.frames_until([&] { return rig.session.comparison.driver_row() != nullptr; }));
      rig.frames(2);
      for (const char* light : {"Coverage", "Live recall"})
        EXPECT_LT(rig.widget(light).max.y - rig.widget(light).min.y, 20) << light << " of " << method.key;
    }
}

TEST(SurfaceRemark, WarnsOfAToleranceThatLetsVerticesThroughFaces) {
  PanelRig rig;
  EXPECT_EQ(ui::surface_remark(rig.session).text, "");
  const double safe = softbody::safe_vertex_tolerance(*rig.session.simulated());
  EXPECT_GT(safe, 0.16 * 0.5);  // of the sphere of 162 vertices and radius 0.5 m
  EXPECT_LT(safe, 0.19 * 0.5);
  rig.change([](softbody::Scene& scene) { scene.collision.tolerance = 0.05f; });
  EXPECT_NE(ui::surface_remark(rig.session).text.find("slip through faces"), std::string::npos);
  rig.change([](softbody::Scene& scene) { scene.contact_surface = softbody::ContactSurface::surfaces; });
  EXPECT_EQ(ui::surface_remark(rig.session).text, "");
}

TEST(SurfaceRemark, CountsTheVerticesInsideOtherBodies) {
  softbody::Scene scene = touching_pair();
  scene.bodies[0].position.x = -0.3;
  scene.bodies[1].position.x = 0.3;
  PanelRig rig(1, scene);
  rig.session.simulation.clock.paused = true;
  rig.click("True surfaces");
  ASSERT_TRUE(rig.frames_until([&] { return rig.session.surfaces.report().id != 0; }));
  const ui::SurfaceRemark remark = ui::surface_remark(rig.session);
  EXPECT_TRUE(remark.penetrates);
  EXPECT_EQ(remark.text.substr(0, 4), "But ") << remark.text;
}

}  // namespace THIS_FILE
}  // namespace app
