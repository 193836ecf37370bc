// The panel's section on stability.

#include "softbody/world/measures.h"
#include "tests/app/panel_rig.h"

namespace app {
namespace THIS_FILE {

TEST(StabilityPanel, ChoosesEveryIntegratorAndItsSubsteps) {
  PanelRig rig;
  rig.click("Detection");  // folds it to make room
  rig.click("Stability");
  const float used_integrator_y = rig.widget("Active integrator").min.y;
  for (const softbody::Integrator& i : softbody::integrators()) {
    if (i.automatic) continue;
    rig.click("Integrator");
    rig.click(i.name);
    EXPECT_EQ(rig.session.simulated()->integrator_choice().integrator().key, i.key);
    EXPECT_FALSE(rig.session.simulated()->integrator_choice().substeps);
    EXPECT_EQ(rig.widget("Active integrator").min.y, used_integrator_y) << "nothing moves";
  }
  rig.click("Fixed substeps");
  EXPECT_TRUE(rig.session.simulated()->integrator_choice().substeps);
  rig.drag("Substeps", -400);
  EXPECT_EQ(rig.session.simulated()->integrator_choice().substeps, 1);
  rig.click("Fixed substeps");
  EXPECT_FALSE(rig.session.simulated()->integrator_choice().substeps);
}

TEST(StabilityPanel, DismissesTheAlarmWhenTheWorldResumes) {
  PanelRig rig(1, doomed_pair());
  rig.frames(40);
  ASSERT_TRUE(rig.session.simulation.clock.paused);
  ASSERT_TRUE(rig.recorder.find("Blow-up"));
  ASSERT_TRUE(rig.recorder.find("Rewind to the last good frame"));
  rig.session.simulation.clock.single_step();
  rig.frames(2);
  EXPECT_TRUE(rig.recorder.find("Blow-up")) << "a single step keeps it";
  rig.click("Pause");
  rig.frames(2);
  EXPECT_FALSE(rig.session.simulation.clock.paused);
  EXPECT_FALSE(rig.recorder.find("Blow-up"));
  EXPECT_FALSE(rig.recorder.find("Rewind to the last good frame"));
}

TEST(StabilityPanel, ShowsItsCurvesAndSwitchesThePauseAtABlowUp) {
  PanelRig rig;
  rig.click("Detection");  // folds it to make room
  rig.click("Numbers");
  rig.click("Stability");
  rig.click("Pause when a body explodes");
  EXPECT_FALSE(rig.session.simulation.pause_on_blow_up);
  EXPECT_TRUE(rig.recorder.find("Total"));
  EXPECT_TRUE(rig.recorder.find("Step light"));
  EXPECT_FALSE(rig.recorder.find("Blow-up"));
}

TEST(StabilityPanel, ShowsAnAlarmAndRewinds) {
  PanelRig rig(1, doomed_pair());
  rig.frames(10);
  EXPECT_TRUE(rig.recorder.find("Blow-up"));
  EXPECT_TRUE(rig.session.simulation.clock.paused);
  rig.click("Rewind to the last good frame");
  EXPECT_FALSE(rig.recorder.find("Blow-up"));
  EXPECT_TRUE(softbody::measure(*rig.session.simulated()).finite);
}

}  // namespace THIS_FILE
}  // namespace app
