// Reads the animations of `simulate --animation` back.

#include <gtest/gtest.h>

#if SBCOLLIDE_GRAPHICS
#include <webp/demux.h>

#include <cstdlib>
#include <memory>
#include <utility>

#include "engine/image.h"
#include "tests/cli/process.h"
#include "tests/load_png.h"

namespace cli::test {
namespace THIS_FILE {

/// What a WebP file shows.
struct Film {
  std::uint32_t width = 0, height = 0, loops = 1;
  std::vector<int> ends;              // when each picture disappears (ms)
  std::vector<std::string> pictures;  // RGBA
};

Film film(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
  const std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> decoder(WebPAnimDecoderNew(&data, nullptr),
                                                                                   &WebPAnimDecoderDelete);
  WebPAnimInfo info;
  if (!decoder || !WebPAnimDecoderGetInfo(decoder.get(), &info)) {
    ADD_FAILURE() << file << " is no WebP file";
    return {};
  }
  Film f{
      .width = info.canvas_width, .height = info.canvas_height, .loops = info.loop_count, .ends = {}, .pictures = {}};
  while (WebPAnimDecoderHasMoreFrames(decoder.get())) {
    std::uint8_t* rgba = nullptr;
    f.ends.push_back(0);
    if (!WebPAnimDecoderGetNext(decoder.get(), &rgba, &f.ends.back())) {
      ADD_FAILURE() << file << ": a picture cannot be read";
      break;
    }
    f.pictures.emplace_back(reinterpret_cast<const char*>(rgba), std::size_t{4} * f.width * f.height);
  }
  return f;
}

/// Returns a command that animates a scene whose bodies move from the first frame on.
Words animate(const std::string& frames, const std::filesystem::path& file, const Words& more = {"--size", "64x48"}) {
  return with({"simulate", "--scene", "A", "--frames", frames, "--animation", file}, more);
}

TEST(Animation, ShowsEverySecondFrameInRealTimeForeverAsCapturesShowIt) {
  const TemporaryFolder folder;
  const Outcome o = run(animate("61", "run.webp", {"--size", "203x117", "--capture", "1,61"}), folder.path());
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.err, "");
  EXPECT_EQ(file_names(folder.path()), (std::set<std::string>{"frame_0001.png", "frame_0061.png", "run.webp"}));
  const Film f = film(folder.path() / "run.webp");
  EXPECT_EQ(f.width, 203u);
  EXPECT_EQ(f.height, 117u);
  EXPECT_EQ(f.loops, 0u) << "0: forever";
  ASSERT_EQ(f.pictures.size(), 31u) << "frames 1, 3, ..., 61";
  for (std::size_t i = 0; i < f.ends.size(); ++i) EXPECT_NEAR(f.ends[i], 1000 * double(i + 1) / 30, 0.5);
  for (const auto& [name, shown] :
       {std::pair("frame_0001.png", f.pictures.front()), std::pair("frame_0061.png", f.pictures.back())}) {
    const engine::Image capture = tests::load_png(folder.path() / name);
    ASSERT_EQ(capture.rgba.size(), shown.size());
    double sum = 0;
    for (std::size_t i = 0; i < shown.size(); ++i)
      sum += std::abs(int(capture.rgba[i]) - int(static_cast<unsigned char>(shown[i])));
    EXPECT_LT(sum / static_cast<double>(shown.size()), 3) << name;
  }
}

TEST(Animation, HasAtMostThirtyPicturesASecond) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.webp";
  struct Case {
    const char *frame_time, *frames;
    std::vector<int> ends;  // ms
  };
  for (const auto& [frame_time, frames, ends] :
       {Case{"0.0166667", "3", {33, 67}}, Case{"0.01", "9", {40, 80, 120}}, Case{"0.1", "2", {100, 200}}}) {
    EXPECT_EQ(run(animate(frames, file, {"--dt", frame_time, "--size", "64x48"})).status, 0);
    EXPECT_EQ(film(file).ends, ends) << "--dt " << frame_time;
  }
}

TEST(Animation, KeepsAPictureForAsLongAsNothingMoves) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.webp";
  // The body of `drop` hangs in the air until frame 84.
  ASSERT_EQ(run({"simulate", "--frames", "95", "--size", "64x48", "--animation", file}).status, 0);
  EXPECT_EQ(film(file).ends, (std::vector<int>{1400, 1433, 1467, 1500, 1533, 1567, 1600}));
}

TEST(Animation, IsAStillImageIfItHasOnePicture) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.webp";
  ASSERT_EQ(run(animate("2", file)).status, 0);
  EXPECT_EQ(film(file).pictures.size(), 1u);
}

TEST(Animation, IsTheSameInEachRunAndDoesNotChangeTheSimulation) {
  const TemporaryFolder folder;
  const auto one = folder.path() / "one.webp", other = folder.path() / "other.webp";
  const auto hash_of = [](const Words& more) {
    return simulate(with({"--scene", "A", "--frames", "20", "--size", "64x48"}, more))["state_hash"];
  };
  const auto hash = hash_of({});
  EXPECT_EQ(hash_of({"--animation", one, "--threads", "1"}), hash);
  EXPECT_EQ(hash_of({"--animation", other, "--threads", "3", "--capture", "1,2", "--out", folder.path()}), hash);
  EXPECT_EQ(read_file(one), read_file(other));
}

TEST(Animation, RefusesWhatAWebPFileCannotHoldBeforeAnythingRuns) {
  const TemporaryFolder folder;
  for (const char* name : {"run.gif", "run.WEBP", "run", "webp", ".webp", "run.webp.png"})
    expect_refused(animate("2", folder.path() / name), {std::string("/") + name + ": the name must end in .webp"});
  const auto file = folder.path() / "run.webp";
  expect_refused(animate("20001", file), {"--animation", "--frames 20000 or fewer"});
  expect_refused(animate("2", file, {"--size", "16384x1"}), {"--animation", "16383", "--size"});
  expect_refused(animate("3", folder.path() / "missing" / "run.webp"), {"missing/run.webp: cannot be written"});
  EXPECT_EQ(file_names(folder.path()), std::set<std::string>{});
}

TEST(Animation, ReplacesOnlyAnOlderWebPFile) {
  const TemporaryFolder folder;
  const auto old = folder.write("old.webp", "RIFF, an old one"), other = folder.write("other.webp", "something else");
  EXPECT_EQ(run(animate("3", old)).status, 0);
  EXPECT_EQ(film(old).pictures.size(), 2u);
  expect_refused(animate("3", other), {"other.webp: cannot be written: it exists"});
  EXPECT_EQ(read_file(other), "something else");
}

}  // namespace THIS_FILE
}  // namespace cli::test
#endif
