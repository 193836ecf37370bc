// Pictures, recordings and curves: what is written, under which names, and which errors are reported.

#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <set>
#include <thread>

#include "app/session/session.h"
#include "softbody/model/body_model.h"
#include "tests/app/recorded_bodies.h"
#include "tests/app/scenes.h"
#include "tests/load_png.h"
#include "tests/read_bodies.h"
#include "tests/temporary_folder.h"

namespace app {
namespace THIS_FILE {

using namespace std::chrono_literals;
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

std::size_t index_of(std::string_view key) {
  for (std::size_t i = 0; i < session::recording_kinds.size(); ++i)
    if (session::recording_kinds[i].key == key) return i;
  ADD_FAILURE() << key;
  return 0;
}

class ExporterTest : public testing::Test {
 protected:
  ExporterTest() { exporter.folder = folder.path().string(); }

  /// Runs a frame of the demo's loop. The picture's colour is the number of the world's frame.
  void frame() {
    exporter.recording() ? session.advance_one(0.02, exporter.may_step()) : session.advance(0.02);
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
    for (const int end = session.world().frame() + steps; session.world().frame() < end && !HasFailure();) {
      frame();
      ASSERT_LT(std::chrono::steady_clock::now(), limit);
    }
  }
  void record(std::string_view kind, int steps) {
    exporter.kind = index_of(kind);
    exporter.toggle_recording();
    frames(steps);
    stop();
  }
  void stop() {
    if (exporter.recording()) exporter.toggle_recording();
    while (exporter.finishing() && std::chrono::steady_clock::now() < limit) {
      std::this_thread::sleep_for(1ms);
      frame();
    }
    ASSERT_FALSE(exporter.finishing());
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
  Session session{touching_pair(), {}, 1};
  std::optional<session::Exporter> owner{std::in_place, session.simulation, session.comparison};
  session::Exporter& exporter = *owner;
  int width = 8, largest = 4096;

 private:
  const std::string path_ = ::getenv("PATH");
  const std::chrono::steady_clock::time_point limit = std::chrono::steady_clock::now() + 120s;
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

TEST_F(ExporterTest, RecordsPicturesOfTheChosenSize) {
  exporter.size = session::Exporter::own;
  exporter.own_size = {34, 22};
  record("pictures", 3);
  EXPECT_EQ(tests::load_png(folder.path() / "pictures_0001" / "picture_00003.png").height, 22);
  EXPECT_EQ(session.simulation.notice.text(), exporter.message()) << "what was written";
  EXPECT_NE(exporter.message().find("3 frames"), std::string::npos) << exporter.message();
}

TEST_F(ExporterTest, ReportsASizeThatTheDriverRefuses) {
  exporter.size = session::Exporter::own;
  exporter.own_size = {5000, 16};
  exporter.picture_requested = true;
  frame();
  EXPECT_TRUE(exporter.failed());
  EXPECT_TRUE(session.simulation.notice.is_error());
  EXPECT_EQ(session.simulation.notice.text(), "too large");
  exporter.kind = index_of("pictures");
  exporter.toggle_recording();
  frame();
  EXPECT_FALSE(exporter.recording());
  stop();
  EXPECT_EQ(exporter.message(), "too large");
  EXPECT_TRUE(exporter.failed());
}

TEST_F(ExporterTest, RecordsEachFrameOnce) {
  session.simulation.clock.slow_motion = true;  // affects the demo, not the recording
  record("pictures", 9);
  const auto sequence = folder.path() / "pictures_0001";
  ASSERT_EQ(names(sequence).size(), 9u);
  for (int i = 1; i <= 9; ++i)
    EXPECT_EQ(tests::load_png(sequence / ("picture_0000" + std::to_string(i) + ".png")).at(0, 0).x, i);
  EXPECT_FALSE(exporter.failed());
  record("pictures", 2);
  EXPECT_TRUE(names(folder.path()).contains("pictures_0002"));
}

TEST_F(ExporterTest, RecordsNothingWhilePaused) {
  exporter.kind = index_of("pictures");
  exporter.toggle_recording();
  frames(2);
  session.simulation.clock.paused = true;
  for (int i = 0; i < 5; ++i) frame();
  stop();
  EXPECT_EQ(names(folder.path() / "pictures_0001").size(), 2u);
}

TEST_F(ExporterTest, ReportsAFolderThatVanishes) {
  exporter.kind = index_of("pictures");
  exporter.toggle_recording();
  std::filesystem::remove_all(folder.path());
  folder.write("in the way", "");
  for (int i = 0; i < 1000 && !exporter.failed(); ++i) {
    frame();
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_TRUE(exporter.failed());
  EXPECT_NE(exporter.message().find("cannot be written"), std::string::npos) << exporter.message();
  EXPECT_FALSE(exporter.recording());
  frame();  // the demo continues
}

TEST_F(ExporterTest, ReportsAFolderThatCannotBeMade) {
  exporter.folder = (folder.write("file", "") / "below").string();
  exporter.picture_requested = true;
  frame();
  EXPECT_TRUE(exporter.failed());
  EXPECT_NE(exporter.message().find("below: cannot be written to"), std::string::npos) << exporter.message();
  exporter.toggle_recording();
  EXPECT_FALSE(exporter.recording());
  EXPECT_TRUE(exporter.failed());
}

TEST_F(ExporterTest, EndsWhenTheRecordingThatPlaysBeginsAgain) {
  const files::Opened balls = opened(std::make_shared<RecordedBalls>(4));
  session.scenes.enter(session::show_in_window(balls, 1), balls.scene, "balls");
  exporter.kind = index_of("motion");
  exporter.toggle_recording();
  for (int i = 0; i < 10'000 && exporter.recording(); ++i) frame();
  EXPECT_FALSE(exporter.recording());
  stop();
  EXPECT_FALSE(exporter.failed()) << exporter.message();
  EXPECT_EQ(names(folder.path()), std::set<std::string>{"motion_0001"});
  EXPECT_EQ(names(folder.path() / "motion_0001").size(), 4u) << "frames 1 to 3 and the rest shape";
}

TEST_F(ExporterTest, WritesMotionThatReadsBackAsTheSameBodies) {
  exporter.kind = index_of("motion");
  exporter.toggle_recording();
  std::vector<compare::Positions> seen;
  for (int i = 0; i < 4; ++i) {
    frames(1);
    seen.emplace_back().copy(session.world().positions());
  }
  session.bodies.drop();
  frames(2);
  stop();
  EXPECT_EQ(
      names(folder.path() / "motion_0001"),
      (std::set<std::string>{"frame_00001.obj", "frame_00002.obj", "frame_00003.obj", "frame_00004.obj", "rest.obj"}));
  EXPECT_EQ(names(folder.path() / "motion_0002").size(), 3u) << "another body needs another folder";
  const softbody::Mesh& mesh = session.world().model(0).mesh;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const files::BodyFile file =
        files::read_bodies(folder.path() / "motion_0001" / ("frame_0000" + std::to_string(i + 1) + ".obj"));
    ASSERT_EQ(file.meshes.count(), 2u);
    EXPECT_EQ(file.at.x, seen[i].x);
    EXPECT_EQ(file.at.y, seen[i].y);
    EXPECT_EQ(file.at.z, seen[i].z);
    std::set<files::BodyMeshes::Edge> edges, expected;
    for (const auto& [a, b] : file.meshes.edges(1)) edges.insert({std::min(a, b), std::max(a, b)});
    for (const auto& [a, b] : mesh.edges) expected.insert({a, b});
    EXPECT_EQ(edges, expected);
  }
}

TEST_F(ExporterTest, PutsAVideoInPlaceWhenFfmpegHasFinished) {
  fake_ffmpeg("for last; do :; done; cat > \"$last\"");
  record("video", 5);
  EXPECT_FALSE(exporter.failed()) << exporter.message();
  EXPECT_EQ(names(folder.path()), std::set<std::string>{"video_0001.mp4"});
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "video_0001.mp4"), 5u * 8 * 6 * 4);
}

TEST_F(ExporterTest, ReportsAMissingFfmpeg) {
  ::setenv("PATH", tools.path().c_str(), 1);
  record("video", 3);
  EXPECT_TRUE(exporter.failed());
  EXPECT_NE(exporter.message().find("install"), std::string::npos) << exporter.message();
  EXPECT_TRUE(names(folder.path()).empty());
}

TEST_F(ExporterTest, ReportsAnFfmpegThatDiesAndLeavesNoFile) {
  fake_ffmpeg("for last; do :; done; echo half > \"$last\"; head -c 100 >/dev/null; echo 'No space left' >&2; exit 1");
  record("video", 12);
  EXPECT_TRUE(exporter.failed());
  EXPECT_NE(exporter.message().find("No space left"), std::string::npos) << exporter.message();
  EXPECT_TRUE(names(folder.path()).empty());
}

TEST_F(ExporterTest, ReportsAtOnceAnFfmpegThatFailsAtTheEnd) {
  fake_ffmpeg("cat >/dev/null; echo 'No space left' >&2; exit 1");
  const auto before = std::chrono::steady_clock::now();
  record("video", 3);
  EXPECT_LT(std::chrono::steady_clock::now() - before, 20s) << "it waited as for an ffmpeg that does not end";
  EXPECT_TRUE(exporter.failed());
  EXPECT_NE(exporter.message().find("No space left"), std::string::npos) << exporter.message();
  EXPECT_TRUE(names(folder.path()).empty());
}

TEST_F(ExporterTest, EndsAVideoWhenThePictureSizeChanges) {
  fake_ffmpeg("for last; do :; done; cat > \"$last\"");
  exporter.kind = index_of("video");
  exporter.toggle_recording();
  frames(3);
  width = 10;
  frames(1);
  stop();
  EXPECT_TRUE(exporter.failed());
  EXPECT_NE(exporter.message().find("size"), std::string::npos) << exporter.message();
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "video_0001.mp4"), 3u * 8 * 6 * 4);
}

TEST_F(ExporterTest, WritesAVideoWithTheRealFfmpeg) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no ffmpeg";
  width = 65;  // odd
  record("video", 5);
  EXPECT_FALSE(exporter.failed()) << exporter.message();
  const std::string bytes = read_file(folder.path() / "video_0001.mp4").substr(0, 12);
  EXPECT_EQ(bytes.substr(4, 4), "ftyp");
}

TEST_F(ExporterTest, CompletesARecordingWhenTheProgramEnds) {
  exporter.kind = index_of("pictures");
  exporter.toggle_recording();
  frames(3);
  owner.reset();
  EXPECT_EQ(names(folder.path() / "pictures_0001").size(), 3u);
}

/// Notes the numbers of its frames, and 0 at the end.
class NumberWriter : public session::FrameWriter {
 public:
  explicit NumberWriter(std::vector<int>& numbers) : numbers_(numbers) {}
  void write(const session::RecordedFrame& frame) override {
    if (frame.number < 0) throw std::runtime_error("no number");
    numbers_.push_back(frame.number);
  }
  void finish() override { numbers_.push_back(0); }
  std::string name() const override { return "numbers"; }

 private:
  std::vector<int>& numbers_;
};

session::RecordedFrame numbered(int number) {
  session::RecordedFrame frame;
  frame.number = number;
  return frame;
}

TEST(FrameRecording, WritesWhatWaitsWithOrWithoutAThread) {
  for (const Runs runs : {Runs::on_thread, Runs::in_slices}) {
    std::vector<int> numbers;
    {
      session::FrameRecording recording(std::make_unique<NumberWriter>(numbers), runs);
      for (const int number : {3, 1, 2}) recording.add(numbered(number));
      EXPECT_EQ(recording.progress().name, "numbers");
      recording.stop("that is enough");
      EXPECT_TRUE(recording.progress().stopping);
      while (!recording.update().ended) continue;
      EXPECT_EQ(recording.progress().written, 3);
      EXPECT_EQ(recording.progress().error, "that is enough");
    }
    EXPECT_EQ(numbers, (std::vector{3, 1, 2, 0}));
  }
}

TEST(FrameRecording, HasRoomForAFewFrames) {
  std::vector<int> numbers;
  {
    session::FrameRecording recording(std::make_unique<NumberWriter>(numbers), Runs::in_slices);
    for (std::size_t i = 0; i < session::FrameRecording::max_waiting; ++i) {
      EXPECT_TRUE(recording.has_room());
      recording.add(numbered(1));
    }
    EXPECT_FALSE(recording.has_room());
    EXPECT_GT(recording.update().written, 0);
    EXPECT_TRUE(recording.has_room());
  }
  EXPECT_EQ(numbers.size(), session::FrameRecording::max_waiting + 1) << "its end waits for all";
}

TEST(FrameRecording, EndsWithTheFirstFrameThatCannotBeWritten) {
  std::vector<int> numbers;
  session::FrameRecording recording(std::make_unique<NumberWriter>(numbers));
  for (const int number : {1, -1, 2}) recording.add(numbered(number));
  while (!recording.update().ended) continue;
  EXPECT_EQ(recording.progress().error, "no number");
  EXPECT_EQ(recording.progress().written, 1);
  EXPECT_FALSE(recording.progress().stopping);
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
