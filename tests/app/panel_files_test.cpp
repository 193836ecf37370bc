// The panel's sections for files, used by mouse and keyboard.

#include <algorithm>
#include <filesystem>
#include <map>

#include "app/session/system_files.h"
#include "softbody/scene/scene.h"
#include "tests/app/panel_rig.h"
#include "tests/temporary_folder.h"

namespace app {
namespace THIS_FILE {

using tests::TemporaryFolder;

TEST(FilesPanel, LoadsTheNamedFile) {
  const TemporaryFolder folder;
  const auto file = folder.write("lone.toml", "name = \"Lone\"\n[[body]]\n");
  PanelRig rig;
  rig.open("Files");
  rig.type("File to open", file.string());
  EXPECT_EQ(rig.session.import.path, file.string());
  rig.click("Load");
  ASSERT_TRUE(rig.frames_until([&] { return !rig.session.import.busy(); }));
  EXPECT_EQ(rig.session.world().scene().name, "Lone");
  rig.type("File to open", "/none.obj");
  rig.click("Load");
  ASSERT_TRUE(rig.frames_until([&] { return !rig.session.import.busy(); }));
  rig.frames(2);
  EXPECT_NE(rig.session.import.problem().find("/none.obj"), std::string::npos) << rig.session.import.problem();
  const auto problem = rig.widget("Load problem");
  EXPECT_GE(problem.min.y, rig.widget("File to open").max.y) << "below its field";
  EXPECT_LE(problem.max.y, rig.widget("Size of meshes").min.y);
  rig.type("File to open", "/none.ob");
  rig.frames(2);
  EXPECT_FALSE(rig.recorder.find("Load problem")) << "another file";
}

TEST(FilesPanel, SetsTheWeldDistanceOfTheNextMesh) {
  PanelRig rig;
  rig.open("Files");
  EXPECT_EQ(rig.session.import.weld, softbody::MeshFile{}.weld);
  rig.drag("Weld distance", -2000);
  EXPECT_EQ(rig.session.import.weld, session::Import::min_weld);
  rig.drag("Weld distance", 2000);
  EXPECT_EQ(rig.session.import.weld, session::Import::max_weld);
  rig.double_click("Weld distance");
  rig.type("20");
  EXPECT_EQ(rig.session.import.weld, 0.02 / double{rig.session.import.size}) << "exactly the typed millimetres";
}

TEST(ImportReport, OffersToLetTheMeshJoinTheSceneBefore) {
  const TemporaryFolder folder;
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  PanelRig rig;
  rig.session.import.drop({folder.write("mine.obj", mesh).string()});
  ASSERT_TRUE(rig.frames_until([&] { return !rig.session.import.busy(); }));
  EXPECT_EQ(rig.session.world().scene().name, "mine.obj");
  rig.open("Files");
  EXPECT_FALSE(rig.widget("Copy").enabled) << "no option makes this scene";
  rig.click("Into the scene before");
  EXPECT_EQ(rig.session.world().scene().name, "Touching pair");
  EXPECT_EQ(rig.session.world().bodies().count(), 3u);
  EXPECT_TRUE(rig.session.import.take_joined());
  EXPECT_FALSE(rig.shows("Into the scene before"));
  rig.frames(3);
  rig.click("Close import report");
  EXPECT_FALSE(rig.shows("Import report"));
}

TEST(ImportReport, ListsEveryFileBelowTheStatus) {
  PanelRig rig;
  rig.resize(800, 600);
  rig.session.import.drop(std::vector<std::string>(20, "/none/with a path that takes more than one line here.stl"));
  rig.frames(40);
  EXPECT_EQ(std::ranges::count(rig.recorder.widgets, "Import report", &ui::WidgetRecorder::Widget::label), 20);
  const float status_end = rig.widget("Live recall").max.y;
  const auto first = std::ranges::find(rig.recorder.widgets, "Import report", &ui::WidgetRecorder::Widget::label);
  EXPECT_GT(first->min.y, status_end) << "a long report scrolls";
}

TEST(FilesPanel, SavesASceneAndAsksBeforeItReplacesAFile) {
  const TemporaryFolder folder;
  const std::string file = folder.write("mine.toml", "# mine\n").string();
  const auto method = [&] { return softbody::load_scene(file).method; };
  PanelRig rig;
  rig.open("Files");
  rig.session.settings.set_method("grid-hash");
  rig.type("Scene file", file);
  for (const char* answer : {"Cancel", "Replace"}) {
    rig.click("Save");
    rig.frames(2);
    EXPECT_EQ(std::filesystem::file_size(file), 7u) << "as it was";
    EXPECT_TRUE(rig.shows("Save question"));
    rig.click(answer);
    rig.frames(2);
    EXPECT_FALSE(rig.shows("Save question"));
  }
  EXPECT_EQ(rig.session.simulation.notice.text(), "Scene saved: " + file);
  EXPECT_EQ(method(), "grid-hash");
  EXPECT_EQ(rig.session.simulation.loaded.file.name(), file);
  rig.session.settings.set_method("brute-force");
  rig.click("Save");
  EXPECT_EQ(method(), "brute-force") << "without a question: it is the scene's own file";
  rig.type("Scene file", "/none/x.toml");
  rig.click("Save");
  rig.frames(2);
  EXPECT_FALSE(rig.session.simulation.notice.is_error()) << rig.session.simulation.notice.text();
  EXPECT_GE(rig.widget("Save problem").min.y, rig.widget("Scene file").max.y) << "below its field";
  rig.type("Scene file", file);
  rig.frames(2);
  EXPECT_FALSE(rig.shows("Save problem")) << "another file";
}

TEST(FilesPanel, CopiesCommandsForTheSettingsInUse) {
  PanelRig rig;
  rig.open("Files");
  rig.session.simulation.clock.paused = true;
  rig.session.settings.set_method("grid-hash");
  const std::string frames = " --frames " + std::to_string(rig.session.world().frame());
  const std::map<std::string, std::vector<std::string>> parts{{"Copy", {" --scene pair --method grid-hash "}},
                                                              {"Copy simulate", {" simulate --scene pair ", frames}}};
  for (const auto& [button, wanted] : parts) {
    rig.click(button);
    const std::string command = ImGui::GetClipboardText();
    for (const std::string& part : wanted) EXPECT_NE(command.find(part), std::string::npos) << command;
    EXPECT_TRUE(rig.session.simulation.notice.text().starts_with("Copied")) << rig.session.simulation.notice.text();
  }
  rig.session.bodies.add({}, {});
  rig.frames(2);
  EXPECT_FALSE(rig.widget("Copy").enabled) << "the file has no such body";
}

TEST(ExportPanel, RequestsAPictureAndRecords) {
  const TemporaryFolder folder;
  PanelRig rig;
  rig.open("Export");
  rig.type("Output folder", folder.path().string());
  EXPECT_EQ(rig.session.exporter.folder, folder.path().string());
  rig.click("Picture");
  EXPECT_TRUE(rig.session.exporter.picture_requested);
  rig.click("Curves");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "curves_0001.csv"));
  for (const session::RecordingKind& kind : session::recording_kinds()) {
    rig.click("Kind of recording");
    rig.click(kind.name);
    EXPECT_EQ(session::recording_kinds()[rig.session.exporter.kind].key, kind.key);
  }
  rig.click("Picture size");
  rig.click("3840 x 2160");
  EXPECT_EQ(rig.session.exporter.size, 2u);
  rig.click("Picture size");
  rig.click("Own size");
  rig.type("Picture width", "64");
  rig.type("Picture height", "99999");
  EXPECT_EQ(rig.session.exporter.own_size, glm::uvec2(64, session::Exporter::max_side));
  rig.click("With the panel");
  EXPECT_FALSE(rig.widget("Picture size").enabled) << "that is the window";
  rig.click("With the panel");
  rig.click("Record");
  EXPECT_TRUE(rig.session.exporter.recording());
  EXPECT_FALSE(rig.widget("Picture size").enabled);
  EXPECT_FALSE(rig.widget("Kind of recording").enabled);
  rig.click("Record");
  EXPECT_FALSE(rig.session.exporter.recording());
}

}  // namespace THIS_FILE
}  // namespace app
