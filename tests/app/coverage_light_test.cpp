#include "app/ui/views/coverage_light.h"

#include "tests/app/panel_rig.h"

namespace app {
namespace {

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

/// The literal method's coverage agrees with the explanation of the largest box.
TEST(CoverageLight, AgreesWithTheLiteralMethod) {
  PanelRig rig;
  rig.session.settings.set_method("multi-level-sb");
  for (const float cell : {0.2f, 2.0f}) {
    collide::Settings settings = rig.session.world().collision();
    settings.cell_size = glm::vec3(cell);
    rig.session.settings.set_collision(settings, false);
    const bool fits = rig.session.world().detection().coverage == collide::Coverage::covered;
    const std::string text = ui::box_against_cell(rig.session.inspector.paper_geometry(), settings.cell_size);
    EXPECT_EQ(text.find("Every box fits") != text.npos, fits) << text;
  }
}

}  // namespace
}  // namespace app
