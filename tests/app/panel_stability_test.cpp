// The panel's section on stability.

#include "softbody/world/measures.h"
#include "tests/app/panel_rig.h"

namespace app {
namespace THIS_FILE {

TEST(StabilityPanel, ChoosesEveryIntegratorAndItsSubsteps) {
  PanelRig rig;
  rig.open("Stability");
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

TEST(StabilityPanel, ShowsAnAlarmUntilTheWorldResumesOrGoesBack) {
  for (const bool rewinds : {false, true}) {
    PanelRig rig(1, doomed_pair());
    EXPECT_FALSE(rig.shows("Blow-up"));
    rig.frames(40);
    ASSERT_TRUE(rig.session.simulation.clock.paused);
    ASSERT_TRUE(rig.shows("Blow-up"));
    rig.session.simulation.clock.single_step();
    rig.frames(2);
    EXPECT_TRUE(rig.shows("Blow-up")) << "a single step keeps it";
    rig.click(rewinds ? "Rewind to the last good frame" : "Pause");
    rig.frames(2);
    EXPECT_FALSE(rig.shows("Blow-up") || rig.shows("Rewind to the last good frame"));
    EXPECT_EQ(rig.session.simulation.clock.paused, rewinds);
    EXPECT_TRUE(softbody::measure(*rig.session.simulated()).finite || !rewinds);
  }
}

TEST(StepLight, IsThereOnlyWhereTheStepIsNotStable) {
  PanelRig rig;
  rig.frames(5);
  EXPECT_FALSE(rig.shows("Step light"));
  rig.session.settings.set_integrator({"explicit-euler"});
  EXPECT_TRUE(rig.frames_until([&] { return rig.shows("Step light"); })) << "only dampers keep it stable";
}

TEST(StabilityPanel, ShowsItsCurvesAndSwitchesThePauseAtABlowUp) {
  PanelRig rig;
  rig.open("Stability");
  rig.click("Pause when a body explodes");
  EXPECT_FALSE(rig.session.simulation.pause_on_blow_up);
  EXPECT_TRUE(rig.shows("Total") && rig.shows("Substep"));
}

}  // namespace THIS_FILE
}  // namespace app
