// The panel's sections for files, used by mouse and keyboard.

#include <algorithm>
#include <fstream>

#include "softbody/model/body_model.h"
#include "softbody/scene/scene.h"
#include "tests/app/panel_rig.h"
#include "tests/temporary_folder.h"

namespace app {
namespace THIS_FILE {

using tests::TemporaryFolder;

/// Opens a section and folds those above it, so that it is visible.
void open_only(PanelRig& rig, std::string_view section) {
  for (const char* above : {"Numbers", "Show", "Detection"}) rig.click(above);
  rig.click(section);
}

TEST(FilesPanel, LoadsTheNamedFile) {
  const TemporaryFolder folder;
  const auto file = folder.write("lone.toml", "name = \"Lone\"\n[[body]]\n");
  PanelRig rig;
  open_only(rig, "Files");
  rig.type("File to open", file.string());
  EXPECT_EQ(rig.session.import.path, file.string());
  rig.click("Load");
  for (int i = 0; i < 6000 && rig.session.import.busy(); ++i) rig.frame();
  EXPECT_EQ(rig.session.world().scene().name, "Lone");
  rig.type("File to open", "/none.obj");
  rig.click("Load");
  for (int i = 0; i < 6000 && rig.session.import.busy(); ++i) rig.frame();
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
  const TemporaryFolder folder;
  const auto mesh = folder.write("slit.obj",
                                 "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 1 0\nv 0.01 0 0\nv 1.01 0 0\n"
                                 "f 1 2 3\nf 1 3 4\nf 3 2 4\nf 5 4 6\n");
  PanelRig rig;
  open_only(rig, "Files");
  const auto import_is_closed = [&] {
    const std::size_t before = rig.session.world().bodies().count();
    rig.session.import.drop({mesh.string()});
    for (int i = 0; i < 6000 && rig.session.world().bodies().count() == before; ++i) rig.frame();
    return rig.session.world().model(rig.session.world().bodies().count() - 1).mesh.closed;
  };
  EXPECT_EQ(rig.session.import.weld, softbody::MeshFile{}.weld);
  EXPECT_FALSE(import_is_closed());
  rig.drag("Weld distance", -2000);
  EXPECT_EQ(rig.session.import.weld, session::Import::min_weld);
  rig.drag("Weld distance", 2000);
  EXPECT_EQ(rig.session.import.weld, session::Import::max_weld);
  rig.double_click("Weld distance");
  rig.type("20");
  EXPECT_EQ(rig.session.import.weld, 0.02 / double{rig.session.import.size}) << "exactly the typed millimetres";
  EXPECT_TRUE(import_is_closed());
}

TEST(FilesPanel, SaysWhichMeshesAreSimulatedByHowManyParticles) {
  PanelRig rig;
  open_only(rig, "Files");
  const ui::WidgetRecorder::Widget resolution = rig.widget("Auto resolution");
  rig.move(resolution.min.x + 5, resolution.min.y + 5);
  rig.frames(60);
  EXPECT_NE(rig.recorder.tooltip.find("more than " + grouped(softbody::max_simulated_vertices) + " vertices"),
            std::string::npos)
      << rig.recorder.tooltip;
  EXPECT_NE(rig.recorder.tooltip.find("by " + grouped(softbody::default_resolution) + " particles"), std::string::npos)
      << rig.recorder.tooltip;
}

TEST(ImportReport, ListsEveryFileBelowTheStatus) {
  PanelRig rig;
  rig.resize(800, 600);
  rig.session.import.drop(std::vector<std::string>(20, "/none/with a path that takes more than one line here.stl"));
  for (int i = 0; i < 40; ++i) rig.frame();
  EXPECT_EQ(std::ranges::count(rig.recorder.widgets, "Import report", &ui::WidgetRecorder::Widget::label), 20);
  const float status_end = rig.widget("Step light").max.y;
  const auto first = std::ranges::find(rig.recorder.widgets, "Import report", &ui::WidgetRecorder::Widget::label);
  EXPECT_GT(first->min.y, status_end) << "a long report scrolls";
}

TEST(FilesPanel, SavesAndReplacesAScene) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "saved.toml").string();
  PanelRig rig;
  open_only(rig, "Files");
  rig.session.settings.set_method("grid-hash");
  rig.type("Scene file", file);
  rig.click("Save");
  EXPECT_EQ(rig.session.simulation.notice.text(), "Scene saved: " + file);
  EXPECT_EQ(softbody::load_scene(file).method, "grid-hash");
  rig.session.settings.set_method("brute-force");
  rig.click("Save");
  EXPECT_EQ(softbody::load_scene(file).method, "brute-force");
  rig.type("Scene file", "/none/x.toml");
  rig.click("Save");
  rig.frames(2);
  EXPECT_FALSE(rig.session.simulation.notice.is_error()) << rig.session.simulation.notice.text();
  EXPECT_GE(rig.widget("Save problem").min.y, rig.widget("Scene file").max.y) << "below its field";
  rig.type("Scene file", file);
  rig.frames(2);
  EXPECT_FALSE(rig.recorder.find("Save problem")) << "another file";
}

TEST(FilesPanel, AsksBeforeItReplacesAFile) {
  const TemporaryFolder folder;
  const auto other = folder.write("other.toml", "# mine\n");
  const auto text = [&] {
    std::ifstream in(other);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  PanelRig rig;
  open_only(rig, "Files");
  rig.type("Scene file", other.string());
  rig.click("Save");
  rig.frames(2);
  EXPECT_EQ(text(), "# mine\n");
  EXPECT_TRUE(rig.recorder.find("Save question"));
  rig.click("Cancel");
  rig.frames(2);
  EXPECT_FALSE(rig.recorder.find("Save question"));
  EXPECT_EQ(text(), "# mine\n");
  rig.click("Save");
  rig.frames(2);
  rig.click("Replace");
  rig.frames(2);
  EXPECT_FALSE(rig.recorder.find("Save question"));
  EXPECT_NE(text(), "# mine\n");
  EXPECT_EQ(rig.session.simulation.loaded.file.name(), other.string());
}

TEST(FilesPanel, CopiesCommandsForTheSettingsInUse) {
  PanelRig rig;
  open_only(rig, "Files");
  rig.session.simulation.clock.paused = true;
  rig.session.settings.set_method("grid-hash");
  rig.click("Copy");
  const std::string demo = ImGui::GetClipboardText();
  EXPECT_NE(demo.find(" --scene pair --method grid-hash "), std::string::npos) << demo;
  EXPECT_TRUE(rig.session.simulation.notice.text().starts_with("Copied")) << rig.session.simulation.notice.text();
  rig.click("Copy simulate");
  const std::string simulate = ImGui::GetClipboardText();
  const std::string end = " --frames " + std::to_string(rig.session.world().frame());
  EXPECT_NE(simulate.find(" simulate --scene pair "), std::string::npos) << simulate;
  EXPECT_NE(simulate.find(end), std::string::npos) << simulate;
  softbody::Material heavy;
  heavy.name = "new";
  heavy[softbody::Material::mass] = 2;
  rig.session.bodies.add({}, heavy);
  rig.frames(2);
  EXPECT_FALSE(rig.widget("Copy").enabled) << "the file has no such body";
}

TEST(TakeAwayPanel, RequestsAPictureAndRecords) {
  const TemporaryFolder folder;
  PanelRig rig;
  open_only(rig, "Export");
  rig.type("Output folder", folder.path().string());
  EXPECT_EQ(rig.session.exporter.folder, folder.path().string());
  rig.click("Picture");
  EXPECT_TRUE(rig.session.exporter.picture_requested);
  rig.click("Curves");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "curves_0001.csv"));
  for (const session::RecordingKind& kind : session::recording_kinds) {
    rig.click("Kind of recording");
    rig.click(kind.name);
    EXPECT_EQ(session::recording_kinds[rig.session.exporter.kind].key, kind.key);
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
