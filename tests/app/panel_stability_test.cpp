// The panel's choice of integrator and substeps.

#include <gtest/gtest.h>

#include "tests/app/panel_rig.h"

namespace app {
namespace {

TEST(StabilityPanel, ChoosesEveryIntegratorAndItsSubsteps) {
  PanelRig rig;
  rig.click("Detection");  // folds it to make room
  rig.click("Stability");
  const float used_integrator_y = rig.widget("At work").min.y;
  for (const softbody::Integrator& i : softbody::integrators()) {
    if (i.automatic) continue;
    rig.click("Integrator");
    rig.click(i.name);
    EXPECT_EQ(rig.session.world().integrator().key, i.key);
    EXPECT_FALSE(rig.session.world().substeps());
    EXPECT_EQ(rig.widget("At work").min.y, used_integrator_y) << "nothing moves";
  }
  rig.click("Fixed substeps");
  EXPECT_TRUE(rig.session.world().substeps());
  rig.drag("Substeps", -400);
  EXPECT_EQ(rig.session.world().substeps(), 1);
  rig.click("Fixed substeps");
  EXPECT_FALSE(rig.session.world().substeps());
}

TEST(StabilityPanel, DismissesTheAlarmWhenTheWorldResumes) {
  PanelRig rig(1, doomed_pair());
  rig.frames(40);
  ASSERT_TRUE(rig.session.paused);
  ASSERT_TRUE(rig.recorder.find("Alarm"));
  ASSERT_TRUE(rig.recorder.find("Rewind to the last good frame"));
  rig.session.single_step();
  rig.frames(2);
  EXPECT_TRUE(rig.recorder.find("Alarm")) << "a single step keeps it";
  rig.click("Pause");
  rig.frames(2);
  EXPECT_FALSE(rig.session.paused);
  EXPECT_FALSE(rig.recorder.find("Alarm"));
  EXPECT_FALSE(rig.recorder.find("Rewind to the last good frame"));
}

}  // namespace
}  // namespace app
