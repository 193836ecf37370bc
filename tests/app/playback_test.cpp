// Files as a recording: what is read when, and what the scene is like.

#include "app/files/playback.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>

#include <glm/trigonometric.hpp>

#include "app/files/obj_writer.h"
#include "app/session/player.h"
#include "engine/camera.h"
#include "tests/app/scenes.h"
#include "tests/temporary_folder.h"

namespace app {
namespace THIS_FILE {

class PlaybackTest : public testing::Test {
 protected:
  /// Writes a frame of `bodies` tetrahedra with edges of 1 m and more; `at`: how far they have moved along x.
  std::filesystem::path write(const std::string& name, int bodies, float at) const {
    std::ostringstream text;
    text << "o empty\n";
    for (int body = 0; body < bodies; ++body) {
      const int first = 4 * body + 1;
      const double x = double(at) + 3 * body;
      text << "o body\nv " << x << " 0 0\nv " << x + 1 << " 0 0\nv " << x << " 1 0\nv " << x << " 0 1\n";
      constexpr std::array<std::array<int, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
      for (const auto& [a, b, c] : faces) text << "f " << first + a << ' ' << first + b << ' ' << first + c << '\n';
    }
    return folder.write(name, text.str());
  }
  std::vector<std::filesystem::path> three() const {
    return {write("0.obj", 2, 0), write("1.obj", 2, 0.5f), write("2.obj", 3, 1)};
  }
  static void expect_refusal(const std::string& says, const std::function<void()>& play) {
    try {
      play();
      FAIL() << "without " << says;
    } catch (const softbody::SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
  }

  tests::TemporaryFolder folder;
};

TEST_F(PlaybackTest, GivesWhatTheFilesHold) {
  files::Playback playback(three());
  ASSERT_EQ(playback.frame_count(), 3);
  for (const int number : {0, 1, 2, 0, 2, 1}) {
    const auto frame = playback.frame(number);
    EXPECT_EQ(frame->body_count, number < 2 ? 2u : 3u) << "without the empty body";
    ASSERT_EQ(frame->x.size(), 4 * frame->body_count);
    EXPECT_EQ(frame->x[0], 0.5f * float(number));
    EXPECT_EQ(frame->x[5], 4 + 0.5f * float(number));
  }
  EXPECT_EQ(playback.model(0), playback.model(2)) << "bodies of one mesh share a model";
  EXPECT_EQ(playback.model(0)->mesh.edges.size(), 6u);
  EXPECT_TRUE(playback.model(0)->mesh.closed);
  EXPECT_EQ(playback.bounds()[0], glm::vec3(0, 0, 0)) << "of the first frame";
  EXPECT_EQ(playback.bounds()[1], glm::vec3(8, 1, 1)) << "of the last frame";
}

TEST_F(PlaybackTest, ReadsAgainOnlyWhatDoesNotFitIntoItsMemory) {
  const auto files = three();
  files::Playback playback(files, {}, 2 * sizeof(float) * 3 * 8);  // two frames
  for (const int number : {0, 1, 2}) playback.frame(number);
  for (const auto& file : files) std::filesystem::remove(file);
  EXPECT_EQ(playback.frame(0)->x[0], 0.0f);
  EXPECT_EQ(playback.frame(1)->x[0], 0.5f);
  EXPECT_THROW(
      {
        playback.frame(2);  // may have been read ahead
        playback.frame(0);
        playback.frame(2);
      },
      softbody::SceneError);
  EXPECT_EQ(playback.frame(1)->x[0], 0.5f) << "others can be read nevertheless";
}

/// The second file becomes a pipe, which somebody opens for reading before its frame is asked for.
TEST_F(PlaybackTest, ReadsTheNextFrameAheadOfTime) {
  const auto files = three();
  files::Playback playback(files, {}, 0);  // keeps none but the first
  std::filesystem::rename(files[1], folder.path() / "text");
  ASSERT_EQ(::mkfifo(files[1].c_str(), S_IRUSR | S_IWUSR), 0);
  playback.frame(0);
  int pipe = -1;
  ASSERT_TRUE(wait_until([&] {
    pipe = ::open(files[1].c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);  // fails while nobody reads
    return pipe >= 0;
  }));
  std::ifstream in(folder.path() / "text");
  const std::string text(std::istreambuf_iterator<char>(in), {});
  EXPECT_EQ(::write(pipe, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  ::close(pipe);
  EXPECT_EQ(playback.frame(1)->x[0], 0.5f);
}

TEST_F(PlaybackTest, ForgetsAllFramesButTheFirstWhenReleased) {
  const auto files = three();
  files::Playback playback(files, {}, 3 * sizeof(float) * (8 + 8));  // two frames
  playback.frame(1);
  playback.release();
  EXPECT_EQ(playback.frame(2)->x[0], 1.0f);
  playback.release();
  for (const auto& file : files) std::filesystem::remove(file);
  EXPECT_EQ(playback.frame(0)->x[0], 0.0f);
  playback.release();  // of what may have been read ahead
  EXPECT_THROW(playback.frame(1), softbody::SceneError);
  write("1.obj", 2, 0.5f);
  EXPECT_EQ(playback.frame(1)->x[0], 0.5f);
  std::filesystem::remove(files[1]);
  EXPECT_EQ(playback.frame(1)->x[0], 0.5f) << "there is room again";
}

TEST_F(PlaybackTest, RefusesFilesWithoutVerticesAndCoordinatesWhoseSquaresWouldOverflow) {
  const softbody::Scene large = files::open_recording({write("large.obj", 1, 9e14f)}).scene;
  EXPECT_TRUE(std::isfinite(large.view.distance) && std::isfinite(large.view.target.x));
  const auto far = write("far.obj", 1, 2e19f);
  expect_refusal("far.obj: a coordinate of 2e+19", [&] { files::open_recording({far}); });
  files::Playback playback({write("0.obj", 1, 0), far});
  expect_refusal("far.obj: a coordinate of 2e+19", [&] { playback.frame(1); });
  EXPECT_TRUE(std::isfinite(playback.bounds()[1].x));
  expect_refusal("no vertex", [&] { files::Playback({folder.write("none.obj", "o nothing\n")}); });
}

/// Returns a row of the vertices of a triangle, at so many metres along x.
std::string triangle_at(double x) {
  std::ostringstream text;
  text.precision(17);
  for (const auto& [dx, dy] : {std::pair(0.0, 0.0), {1.25, 0.0}, {0.0, 0.75}})
    text << "v " << 448262.1 + x + dx << ' ' << 112.3 + dy << " 5411932.7\n";
  return text.str() + "f 1 2 3\n";
}

TEST_F(PlaybackTest, KeepsMotionFarFromTheOrigin) {
  std::vector<std::filesystem::path> files;
  for (const double x : {0.0, 0.01, 12.34})
    files.push_back(folder.write(std::to_string(files.size()) + ".obj", triangle_at(x)));
  files::Playback playback(files);
  const auto first = playback.frame(0);
  EXPECT_NEAR(first->x[1] - first->x[0], 1.25, 1e-6);
  EXPECT_NEAR(first->y[2] - first->y[0], 0.75, 1e-6);
  EXPECT_NEAR(playback.frame(1)->x[0] - first->x[0], 0.01, 1e-6) << "all frames are moved by the same way";
  EXPECT_NEAR(playback.frame(2)->x[2] - first->x[2], 12.34, 2e-6);
  EXPECT_LT(glm::length(playback.bounds()[0]), 10);
  EXPECT_NEAR(playback.usual_tolerance(), 0.625f, 1e-6f);
}

TEST_F(PlaybackTest, NamesItsFilesForACommandLine) {
  const auto files = three();
  EXPECT_EQ(files::Playback(files, files::BodiesBy::components).command_words(),
            (std::vector<std::string>{"--bodies", "components", "--play", files[0], files[1], files[2]}));
}

TEST_F(PlaybackTest, SaysWhichFileIsBrokenAndGoesOn) {
  const auto files = three();
  folder.write("1.obj", "v 0 0 x\n");
  files::Playback playback(files);
  for (int i = 0; i < 2; ++i) expect_refusal("1.obj:1", [&] { playback.frame(1); });
  EXPECT_EQ(playback.frame(2)->x[0], 1.0f);
}

TEST_F(PlaybackTest, RefusesAnotherBodyInThePlaceOfALaterOne) {
  const std::string two = "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto first = folder.write("0.obj", two),
             grown = folder.write("1.obj", two + "o b\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf 4 5 6\n"),
             other = folder.write("2.obj", two + "o b\nv 0 0 1\nv 1 0 1\n");
  files::Playback playback({first, grown, other, grown});
  EXPECT_EQ(playback.frame(1)->body_count, 2u);
  expect_refusal("2.obj: body 1", [&] { playback.frame(2); });
  EXPECT_EQ(playback.frame(3)->body_count, 2u);
}

TEST_F(PlaybackTest, MakesASceneWhoseViewShowsAllFrames) {
  const auto [scene, recording] = files::open_recording(three());
  const auto [low, high] = *session::Player(recording, scene, 1).bounds();
  engine::Camera camera;
  camera.fit(glm::vec3(scene.view.target), 10, {});
  camera.set_orbit({glm::vec3(scene.view.target), static_cast<float>(scene.view.distance),
                    static_cast<float>(glm::radians(scene.view.azimuth)),
                    static_cast<float>(glm::radians(scene.view.elevation))});
  for (const float x : {low.x, high.x})
    for (const float y : {low.y, high.y})
      for (const float z : {low.z, high.z}) {
        const glm::vec3 pixel = camera.project({x, y, z}, {150, 100}).value();
        EXPECT_TRUE(pixel.x > 0 && pixel.x < 150 && pixel.y > 0 && pixel.y < 100) << x << ' ' << y << ' ' << z;
      }
}

TEST_F(PlaybackTest, MakesASceneWhoseToleranceSuitsTheData) {
  const auto [scene, recording] = files::open_recording(three());
  EXPECT_NEAR(scene.collision.tolerance, std::sqrt(2.0f) / 2, 1e-6) << "half the median edge";
  EXPECT_EQ(scene.view.target, glm::dvec3(4, 0.5, 0.5));
  session::Player player(recording, scene, 1);
  player.show(2);
  EXPECT_EQ(player.bodies().count(), 3u);
  const auto points = folder.write("points.ply",
                                   "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                                   "property float z\nend_header\n0 0 0\n3 0 4\n");
  EXPECT_NEAR(files::open_recording({points}).scene.collision.tolerance, 0.05, 1e-6) << "a hundredth of the diagonal";
}

/// A world and a frame of it in a folder, with its surroundings.
class SurroundingsTest : public PlaybackTest {
 protected:
  SurroundingsTest() {
    world.step();
    const collide::Frame at = world.positions();
    const files::ObjWriter writer(world);
    writer.write_surroundings(folder.path());
    folder.write("frame_0001.obj", writer.frame({at.x, at.y, at.z}));
  }
  static softbody::Scene scene_of_world() {
    softbody::Scene scene = touching_pair();
    scene.name = "\xff";  // as of a file
    scene.method = "multi-level-sb";
    scene.collision.tolerance = 0.07f;
    scene.collision.self_collision = false;
    scene.view.azimuth = 77;
    return scene;
  }
  files::Opened open(const char* frame = "frame_0001.obj") { return files::open_recording({folder.path() / frame}); }

  softbody::World world{scene_of_world(), {}};
};

TEST_F(SurroundingsTest, KeepSolidsCameraAndHowContactsAreFound) {
  const files::Opened opened = open();
  EXPECT_EQ(opened.scene.name, "frame_0001.obj");
  EXPECT_EQ(opened.scene.solids, world.scene().solids);
  EXPECT_EQ(opened.scene.view, world.scene().view);
  EXPECT_EQ(opened.scene.method, "multi-level-sb");
  EXPECT_EQ(opened.scene.collision, world.scene().collision);
  EXPECT_TRUE(opened.scene.bodies.empty());
  EXPECT_EQ(opened.recording->frame(0)->y[0], world.positions().y[0]) << "the bodies stay at their solids";
}

TEST_F(SurroundingsTest, AreThoseOfFramesOfThisProgramAlone) {
  for (const char* name : {"walk_0001.obj", "frame_left.obj", "frame_0001.ply.obj"}) {
    std::filesystem::copy(folder.path() / "frame_0001.obj", folder.path() / name);
    EXPECT_TRUE(open(name).scene.solids.empty()) << name;
  }
}

TEST_F(SurroundingsTest, MayBeWrittenByHandAndPlayNoBodies) {
  folder.write("scene.toml", "[[body]]\nposition = [0, 9, 0]\n[ground]\nheight = -2\n[[caption]]\ntext = \"no\"\n");
  const files::Opened opened = open();
  EXPECT_EQ(opened.scene.solids.size(), 1u);
  EXPECT_TRUE(opened.scene.bodies.empty());
  EXPECT_TRUE(opened.scene.captions.empty());
  EXPECT_FALSE(opened.scene.dropper);
  folder.write("scene.toml", "[ground]\nheight = 0\nfriction = 77\n");
  expect_refusal("scene.toml:3", [&] { open(); });
}

/// Tolerances and cells of what is played may be larger than a scene file allows.
TEST_F(SurroundingsTest, AreLeftOutWhereNoSceneFileHoldsThem) {
  files::Opened opened = files::open_recording({write("large.obj", 1, 9e14f)});
  opened.scene.collision.tolerance = 50;
  const session::Player player(opened.recording, opened.scene, 1);
  const tests::TemporaryFolder empty;
  files::ObjWriter(player).write_surroundings(empty.path());
  EXPECT_TRUE(std::filesystem::is_empty(empty.path()));
}

}  // namespace THIS_FILE
}  // namespace app
