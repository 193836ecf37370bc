// Compares pictures of the paper's four moments with the golden pictures, which were made by
//   sbcollide simulate --frames 800 --capture 100,400,600,800 --size 320x180 --out tests/app/golden
// and change only if the scene or the drawing is meant to change.

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "app/render/capture.h"
#include "engine/image.h"
#include "engine/resources.h"
#include "softbody/world/world.h"
#include "tests/load_png.h"

namespace app {
namespace THIS_FILE {

struct Difference {
  double mean = 0;        // of all channels, 0 .. 255
  double far_pixels = 0;  // share of pixels in which some channel differs by more than 32
};

Difference difference(const engine::Image& a, const engine::Image& b) {
  Difference d;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      int largest = 0;
      for (int k = 0; k < 3; ++k) {
        const int step = std::abs(int(a.at(x, y)[k]) - int(b.at(x, y)[k]));
        d.mean += step / 3.0;
        largest = std::max(largest, step);
      }
      d.far_pixels += largest > 32;
    }
  const double pixels = double(a.width) * b.height;
  return {d.mean / pixels, d.far_pixels / pixels};
}

// Another driver draws edges and shadows slightly differently. Pictures of two different moments differ in more than a
// tenth of their pixels.
TEST(Capture, ShowsThePapersFourMomentsOfTheDropScene) {
  const std::filesystem::path golden = SBCOLLIDE_GOLDEN_DIR;
  softbody::World world(softbody::find_scene("drop", engine::find_folder("assets") / "scenes"), {});
  render::Capture capture({320, 180});
  engine::Image before;
  for (const int frame : {100, 400, 600, 800}) {
    while (world.frame() < frame) world.step();
    const engine::Image now = capture.draw(world);
    const engine::Image kept = tests::load_png(golden / ("frame_0" + std::to_string(frame) + ".png"));
    ASSERT_EQ(now.width, kept.width);
    ASSERT_EQ(now.height, kept.height);
    const Difference d = difference(now, kept);
    EXPECT_LT(d.mean, 1.5) << "frame " << frame;
    EXPECT_LT(d.far_pixels, 0.01) << "frame " << frame;
    if (!before.rgba.empty()) {
      EXPECT_GT(difference(before, kept).far_pixels, 0.04) << "frame " << frame;
    }
    before = kept;
  }
}

}  // namespace THIS_FILE
}  // namespace app
