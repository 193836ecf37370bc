// Pictures, recordings and curves: what is written, under which names, and which errors are reported.

#include <gtest/gtest.h>
#include <stdlib.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>

#include "app/files/playback.h"
#include "app/session/session.h"
#include "app/session/system_files.h"
#include "softbody/forces/springs.h"
#include "tests/app/recorded_bodies.h"
#include "tests/app/scenes.h"
#include "tests/load_png.h"
#include "tests/read_bodies.h"
#include "tests/temporary_folder.h"

namespace app {
namespace THIS_FILE {

using tests::TemporaryFolder;

std::set<std::string> names(const std::filesystem::path& folder) {
  std::set<std::string> list;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) list.insert(entry.path().filename().string());
  return list;
}

std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class ExporterTest : public testing::Test {
 protected:
  ExporterTest() {
    exporter.folder = folder.path().string();
    std::signal(SIGPIPE, SIG_IGN);  // as the program does
  }

  /// Runs a frame of the demo's loop. The picture's colour is the number of the world's frame.
  void frame() {
    session.advance(0.02);
    exporter.frame([&](bool with_panel, const std::optional<glm::uvec2>& asked) {
      const glm::ivec2 pixels = asked ? glm::ivec2(*asked) : glm::ivec2(width, 6);
      if (pixels.x > largest) throw std::runtime_error("too large");
      engine::Image image{pixels.x, pixels.y, {}};
      image.rgba.assign(static_cast<std::size_t>(pixels.x * pixels.y) * 4,
                        static_cast<std::uint8_t>(session.world().frame()));
      EXPECT_EQ(with_panel, exporter.with_panel);
      return image;
    });
  }
  /// Runs frames until the world has taken so many further steps.
  void frames(int steps) {
    const int end = session.world().frame() + steps;
    ASSERT_TRUE(wait_until([&] {
      frame();
      return session.world().frame() >= end || HasFailure();
    }));
  }
  void start(std::string_view kind) {
    const std::span kinds = session::recording_kinds();
    const auto row = std::ranges::find(kinds, kind, &session::RecordingKind::key);
    exporter.kind = static_cast<std::size_t>(row - kinds.begin());
    exporter.toggle_recording();
  }
  void record(std::string_view kind, int steps) {
    start(kind);
    frames(steps);
    stop();
  }
  void stop() {
    if (exporter.recording()) exporter.toggle_recording();
    ASSERT_TRUE(wait_until([&] {
      if (exporter.finishing()) frame();
      return !exporter.finishing();
    }));
  }
  void expect_failure(const std::string& says) const {
    EXPECT_TRUE(exporter.failed());
    EXPECT_NE(exporter.message().find(says), std::string::npos) << exporter.message();
  }
  /// Makes an executable called ffmpeg the only program on the path.
  void fake_ffmpeg(const std::string& script) {
    std::filesystem::create_directories(tools.path());
    const auto file = tools.write("ffmpeg", "#!/bin/sh\nPATH=/usr/bin:/bin\n" + script);
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    ::setenv("PATH", tools.path().c_str(), 1);
  }
  ~ExporterTest() override { ::setenv("PATH", path_.c_str(), 1); }

  TemporaryFolder folder, tools;
  std::unique_ptr<Session> owner = std::make_unique<Session>(touching_pair(), std::filesystem::path(), 1);
  Session& session = *owner;
  session::Exporter& exporter = session.exporter;
  int width = 8, largest = 4096;

 private:
  const std::string path_ = ::getenv("PATH");
};

TEST_F(ExporterTest, GivesPicturesTheNextFreeName) {
  folder.write("picture_0002.png", "mine");
  for (int i = 0; i < 2; ++i) {
    exporter.picture_requested = true;
    frame();
    EXPECT_FALSE(exporter.failed()) << exporter.message();
    frame();
  }
  EXPECT_EQ(names(folder.path()), (std::set<std::string>{"picture_0001.png", "picture_0002.png", "picture_0003.png"}));
  EXPECT_EQ(read_file(folder.path() / "picture_0002.png"), "mine");
  EXPECT_EQ(tests::load_png(folder.path() / "picture_0001.png").at(0, 0).x, 1);
  EXPECT_NE(exporter.message().find("picture_0003.png"), std::string::npos);
}

TEST_F(ExporterTest, TakesPicturesOfTheChosenSize) {
  const auto take = [&] {
    exporter.picture_requested = true;
    frame();
    return exporter.message().substr(exporter.message().find(" ("));
  };
  EXPECT_EQ(take(), " (8 x 6)");
  exporter.size = 1;
  EXPECT_EQ(take(), " (1920 x 1080)");
  exporter.size = session::Exporter::own;
  exporter.own_size = {33, 21};
  EXPECT_EQ(take(), " (33 x 21)");
  EXPECT_EQ(tests::load_png(folder.path() / "picture_0003.png").width, 33);
  EXPECT_EQ(session.simulation.notice.text(), exporter.message());
  EXPECT_FALSE(session.simulation.notice.is_error());
  exporter.with_panel = true;
  EXPECT_EQ(take(), " (8 x 6)") << "that is the window";
}

TEST_F(ExporterTest, ReportsASizeThatTheDriverRefuses) {
  exporter.size = session::Exporter::own;
  exporter.own_size = {5000, 16};
  exporter.picture_requested = true;
  frame();
  EXPECT_TRUE(exporter.failed());
  EXPECT_TRUE(session.simulation.notice.is_error());
  EXPECT_EQ(session.simulation.notice.text(), "too large");
  start("pictures");
  frame();
  EXPECT_FALSE(exporter.recording());
  stop();
  EXPECT_EQ(exporter.message(), "too large");
  EXPECT_TRUE(exporter.failed());
}

TEST_F(ExporterTest, RecordsEachFrameOnceInTheChosenSize) {
  exporter.size = session::Exporter::own;
  exporter.own_size = {34, 22};
  session.simulation.clock.slow_motion = true;  // affects the demo, not the recording
  start("pictures");
  frames(9);
  session.simulation.clock.paused = true;
  for (int i = 0; i < 5; ++i) frame();
  stop();
  const auto sequence = folder.path() / "pictures_0001";
  ASSERT_EQ(names(sequence).size(), 9u);
  for (int i = 1; i <= 9; ++i) {
    const engine::Image picture = tests::load_png(sequence / ("picture_0000" + std::to_string(i) + ".png"));
    EXPECT_EQ(picture.at(0, 0).x, i);
    EXPECT_EQ(picture.height, 22);
  }
  EXPECT_FALSE(exporter.failed());
  EXPECT_NE(exporter.message().find("9 frames"), std::string::npos) << exporter.message();
  EXPECT_EQ(session.simulation.notice.text(), exporter.message());
  session.simulation.clock.paused = false;
  record("pictures", 2);
  EXPECT_TRUE(names(folder.path()).contains("pictures_0002"));
}

TEST_F(ExporterTest, ReportsAFolderThatVanishes) {
  start("pictures");
  std::filesystem::remove_all(folder.path());
  folder.write("in the way", "");
  wait_until([&] {
    frame();
    return exporter.failed();
  });
  expect_failure("cannot be written");
  EXPECT_FALSE(exporter.recording());
  frame();  // the demo continues
}

TEST_F(ExporterTest, ReportsAFolderThatCannotBeMade) {
  exporter.folder = (folder.write("file", "") / "below").string();
  exporter.picture_requested = true;
  frame();
  expect_failure("below: cannot be written to");
  exporter.toggle_recording();
  EXPECT_FALSE(exporter.recording());
  EXPECT_TRUE(exporter.failed());
}

TEST_F(ExporterTest, EndsWhenTheRecordingThatPlaysBeginsAgain) {
  const files::Opened balls = opened(std::make_shared<RecordedBalls>(4));
  session.scenes.enter(session::show_in_window(balls, 1), balls.scene, "balls");
  start("motion");
  for (int i = 0; i < 10'000 && exporter.recording(); ++i) frame();
  EXPECT_FALSE(exporter.recording());
  stop();
  EXPECT_FALSE(exporter.failed()) << exporter.message();
  EXPECT_EQ(names(folder.path()), std::set<std::string>{"motion_0001"});
  EXPECT_EQ(names(folder.path() / "motion_0001").size(), 5u) << "frames 1 to 3, the rest shape and the scene";
}

TEST_F(ExporterTest, GoesOnWithTheSecondHalfWhenTheFirstHasStopped) {
  softbody::Scene stiff = touching_pair();
  stiff.materials[0][softbody::StructuralSprings::stiffness] = 20'000;
  session.scenes.enter(session::make_window_world(stiff, {"explicit-euler", 1}, 1), stiff, "stiff");
  session.simulation.set_beside(compare::HowSimulated{stiff, {}});
  start("pictures");
  ASSERT_TRUE(wait_until([&] {
    frame();
    return session.simulation.world(session::Half::second).frame() >= 60;
  }));
  stop();
  EXPECT_LT(session.world().frame(), 50);
  EXPECT_EQ(names(folder.path() / "pictures_0001").size(), 60u);
}

TEST_F(ExporterTest, WritesMotionThatReadsBackAsTheSameBodies) {
  start("motion");
  std::vector<compare::Positions> seen;
  for (int i = 0; i < 4; ++i) {
    frames(1);
    seen.emplace_back().copy(session.world().positions());
  }
  session.bodies.drop();
  frames(2);
  stop();
  EXPECT_EQ(names(folder.path() / "motion_0001"),
            (std::set<std::string>{"frame_00001.obj", "frame_00002.obj", "frame_00003.obj", "frame_00004.obj",
                                   "rest.obj", "scene.toml"}));
  EXPECT_EQ(names(folder.path() / "motion_0002").size(), 4u) << "another body needs another folder";
  const std::filesystem::path frame = folder.path() / "motion_0002" / "frame_00005.obj";
  EXPECT_EQ(files::open_recording({frame}).scene.solids, session.world().scene().solids);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const files::BodyFile file =
        files::read_bodies(folder.path() / "motion_0001" / ("frame_0000" + std::to_string(i + 1) + ".obj"));
    ASSERT_EQ(file.meshes.count(), 2u);
    EXPECT_EQ(file.at.x, seen[i].x);
    EXPECT_EQ(file.at.y, seen[i].y);
    EXPECT_EQ(file.at.z, seen[i].z);
  }
}

TEST_F(ExporterTest, PutsAVideoInPlaceWhenFfmpegHasFinished) {
  fake_ffmpeg("for last; do :; done; cat > \"$last\"");
  record("video", 5);
  EXPECT_FALSE(exporter.failed()) << exporter.message();
  EXPECT_EQ(names(folder.path()), std::set<std::string>{"video_0001.mp4"});
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "video_0001.mp4"), 5u * 8 * 6 * 4);
}

TEST_F(ExporterTest, ReportsAnFfmpegThatIsMissingOrFailsAndLeavesNoFile) {
  ::setenv("PATH", tools.path().c_str(), 1);
  record("video", 3);
  expect_failure("install");
  fake_ffmpeg("for last; do :; done; echo half > \"$last\"; head -c 100 >/dev/null; echo 'No space left' >&2; exit 1");
  record("video", 12);
  expect_failure("No space left");
  fake_ffmpeg("cat >/dev/null; echo 'No room left' >&2; exit 1");
  record("video", 3);
  expect_failure("No room left");
  EXPECT_TRUE(names(folder.path()).empty());
}

TEST_F(ExporterTest, EndsAVideoWhenThePictureSizeChanges) {
  fake_ffmpeg("for last; do :; done; cat > \"$last\"");
  start("video");
  frames(3);
  width = 10;
  frames(1);
  stop();
  expect_failure("size");
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "video_0001.mp4"), 3u * 8 * 6 * 4);
}

TEST_F(ExporterTest, WritesAVideoWithTheRealFfmpeg) {
  if (std::system("command -v ffmpeg >/dev/null") != 0) GTEST_SKIP() << "no ffmpeg";
  width = 65;  // odd
  record("video", 5);
  EXPECT_FALSE(exporter.failed()) << exporter.message();
  const std::string bytes = read_file(folder.path() / "video_0001.mp4").substr(0, 12);
  EXPECT_EQ(bytes.substr(4, 4), "ftyp");
}

TEST_F(ExporterTest, LetsTheWorldWaitForTheWriterAndCompletesARecordingWhenTheProgramEnds) {
  fake_ffmpeg("while ! test -e " + (tools.path() / "go").string() +
              "; do sleep 0.05; done; for last; do :; done; cat > \"$last\"");
  exporter.size = session::Exporter::own;
  exporter.own_size = {640, 480};  // more than waits between two processes
  start("video");
  for (int i = 0; i < 20; ++i) frame();
  EXPECT_LE(session.world().frame(), 1 + int{session::RecordingTask::max_waiting});
  tools.write("go", "");
  frames(5);
  const auto written = static_cast<std::size_t>(session.world().frame());
  owner.reset();
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "video_0001.mp4"), written * 640 * 480 * 4);
}

TEST_F(ExporterTest, WritesALineOfCurvesForEachFrame) {
  frames(7);
  exporter.write_curves();
  EXPECT_FALSE(exporter.failed()) << exporter.message();
  std::ifstream file(folder.path() / "curves_0001.csv");
  std::string heading, line, last;
  std::getline(file, heading);
  EXPECT_EQ(heading.substr(0, 43), "frame,frame_ms,detect_ms,solve_ms,contacts,");
  const int first = session.world().frame() - 7;  // its picture took time, but it took no step
  int number = first;
  for (; std::getline(file, line); last = line) EXPECT_EQ(line.substr(0, line.find(',')), std::to_string(number++));
  EXPECT_EQ(number, first + 8);
  const std::string contacts = "," + std::to_string(session.world().detection().contacts.size()) + ",";
  EXPECT_NE(last.find(contacts), std::string::npos) << last;
}

}  // namespace THIS_FILE
}  // namespace app
