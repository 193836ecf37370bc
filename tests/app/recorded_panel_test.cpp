// The interface on a recording: what is there, and that what needs a solver is left out and says so.

#include "app/window/scene_picture.h"
#include "tests/app/keys.h"
#include "tests/app/panel_rig.h"
#include "tests/app/recorded_bodies.h"

#include <GLFW/glfw3.h>

namespace app {
namespace THIS_FILE {

class RecordedPanel : public testing::Test {
 protected:
  RecordedPanel() {
    rig.session.simulation.clock.paused = true;
    rig.frames(2);
  }
  bool shows(std::string_view label) const { return rig.shows(label); }

  PanelRig rig{1, opened(std::make_shared<RecordedBalls>(60))};
};

TEST_F(RecordedPanel, LeavesOutWhatNeedsASolverAndSaysSo) {
  rig.open("Bodies");
  for (const char* label : {"Detection", "Numbers", "Files", "Export", "Contacts", "Left out", "Method", "Tolerance"})
    EXPECT_TRUE(shows(label)) << label;
  for (const char* label : {"World", "Solids", "Stability", "Springs", "Surface contacts", "Drop", "Throw", "Delete",
                            "Solve", "Contact surface", "Step light", "Contacts with solids"})
    EXPECT_FALSE(shows(label)) << label;
  rig.session.bodies.select(1);
  rig.frames(2);
  EXPECT_TRUE(shows("Selected body") && shows("Look at it"));
  EXPECT_FALSE(shows("Delete") || shows("Speed, volume"));
}

TEST_F(RecordedPanel, AnswersKeysThatNeedASolverWithTheReason) {
  for (const int key : {GLFW_KEY_D, GLFW_KEY_B, GLFW_KEY_DELETE, GLFW_KEY_F, int('5'), int('8')}) {
    rig.session.simulation.notice.clear();
    EXPECT_TRUE(handle_key(key, false, rig.session, rig.ui));
    const std::string& said = rig.session.simulation.notice.text();
    EXPECT_NE(said.find("left out, the motion is recorded"), std::string::npos) << key << ' ' << said;
  }
  EXPECT_FALSE(rig.ui.overlays.springs || rig.ui.overlays.surface_contacts);
  EXPECT_EQ(rig.session.world().scene().contact_surface, softbody::ContactSurface::vertices);
  handle_key(GLFW_KEY_M, false, rig.session, rig.ui);
  EXPECT_NE(rig.session.world().method().key, collide::default_method);
}

TEST_F(RecordedPanel, HasATimeLineOverAllFrames) {
  rig.drag("Time line", 2000);
  EXPECT_EQ(rig.session.world().frame(), 59);
  rig.drag("Time line", -2000);
  EXPECT_EQ(rig.session.world().frame(), 0);
  rig.click("Step");
  EXPECT_EQ(rig.session.world().frame(), 1);
  rig.click("Loop");
  EXPECT_FALSE(rig.session.simulation.loop);
  rig.drag("Speed", 500);
  EXPECT_NEAR(rig.session.simulation.clock.speed, 4, 1e-3);
  rig.click("Pause");
  rig.frames(40);
  EXPECT_EQ(rig.session.world().frame(), 59);
  EXPECT_TRUE(rig.session.simulation.clock.paused);
}

TEST_F(RecordedPanel, DrawsNoOverlayThatNeedsASolverButKeepsTheChoice) {
  rig.ui.overlays.springs = rig.ui.overlays.surface_contacts = rig.ui.overlays.contacts = true;
  const render::Overlays chosen = rig.ui.overlays;
  rig.frames(1);
  const render::Overlays drawn = window::scene_picture(rig.session, rig.ui, {}, 1).shown;
  EXPECT_FALSE(drawn.springs || drawn.surface_contacts);
  EXPECT_TRUE(drawn.contacts);
  EXPECT_EQ(rig.ui.overlays, chosen) << "for the next scene, and for the preferences";
}

TEST_F(RecordedPanel, OpensFilesAndGivesTheCommandThatPlaysTheRecording) {
  rig.open("Files");
  EXPECT_TRUE(shows("File to open") && shows("Load"));
  for (const char* label : {"Size of meshes", "Weld distance", "Scene file", "Copy simulate"})
    EXPECT_FALSE(shows(label)) << label;
  rig.click("Copy");
  const std::string command = ImGui::GetClipboardText();
  EXPECT_NE(command.find(" --play '"), std::string::npos) << command;
  EXPECT_NE(command.find("/ball 59.obj' --method "), std::string::npos) << command;
  for (const char* option : {"--scene", "--contact-surface", "--integrator"})
    EXPECT_EQ(command.find(option), std::string::npos) << command;
}

TEST_F(RecordedPanel, TourFindsItsExampleInALaterFrame) {
  handle_key(GLFW_KEY_G, false, rig.session, rig.ui);
  ASSERT_TRUE(rig.ui.tour.open());
  EXPECT_TRUE(rig.frames_until([&] { return shows("Tour claims"); }));
  EXPECT_GT(rig.session.world().frame(), 1) << "the balls touch later";
  EXPECT_FALSE(rig.session.world().detection().contacts.empty());
  rig.click("Close tour");
  EXPECT_FALSE(rig.ui.tour.open());
}

TEST_F(RecordedPanel, DrawsEveryView) {
  for (const int key : {GLFW_KEY_V, GLFW_KEY_E, GLFW_KEY_W, GLFW_KEY_T, int('1'), int('2'), int('3'), int('4'),
                        int('6'), int('7'), int('9')}) {
    handle_key(key, false, rig.session, rig.ui);
    rig.frames(3);
  }
  EXPECT_FALSE(rig.session.simulation.notice.is_error()) << rig.session.simulation.notice.text();
}

}  // namespace THIS_FILE
}  // namespace app
