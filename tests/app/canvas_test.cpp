#include <gtest/gtest.h>

#include <optional>

#include "app/render/canvas.h"
#include "engine/headless.h"

namespace app {
namespace THIS_FILE {

/// The cost of pictures: `fixed` s to draw at any size, `pixels` s more with all pixels, and `other` s for other work.
struct Cost {
  double fixed, pixels, other;
  void draw(render::RenderScale& render_scale) const {
    const double drawing = fixed + pixels * double(render_scale.value()) * double(render_scale.value());
    render_scale.add(drawing + other, drawing);
  }
};

float after(int pictures, render::RenderScale& render_scale, const Cost& cost) {
  for (int i = 0; i < pictures; ++i) cost.draw(render_scale);
  return render_scale.value();
}

TEST(RenderScale, DropsIfDrawingTakesTooLong) {
  render::RenderScale render_scale;
  EXPECT_EQ(render_scale.value(), 1);
  EXPECT_EQ(after(200, render_scale, {0.005, 0.020, 0.005}), 1);
  EXPECT_EQ(after(200, render_scale, {0.005, 0.030, 0.005}), 0.8f);
  EXPECT_EQ(after(200, render_scale, {0.010, 0.080, 0.005}), 0.55f);
  EXPECT_EQ(after(200, render_scale, {0.001, 0.004, 0.025}), 1) << "it rises again";
  EXPECT_EQ(after(200, render_scale, {0.005, 0.015, 0.050}), 1) << "something else is slow";
}

TEST(RenderScale, StaysIfA60HzScreenRarelyMissesAFrame) {
  render::RenderScale render_scale;
  for (int i = 0; i < 400; ++i) render_scale.add(i % 36 == 7 ? 3.0 / 60 : 2.0 / 60, 0.025);
  EXPECT_EQ(render_scale.value(), 1);
  for (int i = 0; i < 400; ++i) render_scale.add(i % 9 == 7 ? 3.0 / 60 : 2.0 / 60, 0.025);
  EXPECT_LT(render_scale.value(), 1) << "but it drops if most frames are missed";
}

TEST(RenderScale, SettlesForAnyCostOfDrawing) {
  for (double fixed = 0.001; fixed < 0.06; fixed *= 1.3)
    for (double pixels = 0.001; pixels < 0.2; pixels *= 1.3)
      for (const double other : {0.001, 0.01, 0.03}) {
        const Cost cost{fixed, pixels, other};
        render::RenderScale render_scale;
        const float settled = after(200, render_scale, cost);
        for (int i = 0; i < 100; ++i)
          ASSERT_EQ(after(1, render_scale, cost), settled) << fixed << " " << pixels << " " << other;
      }
}

class CanvasTest : public testing::Test {
 protected:
  static constexpr glm::ivec2 size{64, 48};

  /// Updates the canvas. Returns the size that was drawn; nothing if nothing was drawn.
  std::optional<glm::ivec2> drawn(bool changed, bool fine) {
    std::optional<glm::ivec2> target;
    canvas_.update(size, changed, fine, [&](const engine::Viewport& whole) {
      target = whole.size;
      glClearColor(changed ? 1 : 0, 1, 0, 1);
      glClear(GL_COLOR_BUFFER_BIT);
    });
    return target;
  }
  void let_it_be_slow() {
    for (int i = 0; i < 200; ++i) canvas_.add_timing(0.1, 0.09);
  }

  engine::HeadlessContext context_;  // first member: the canvas requires it
  render::Canvas canvas_{true};
};

TEST_F(CanvasTest, DrawsAChangedSceneOnceAndOnceMoreFine) {
  EXPECT_EQ(drawn(false, false), size) << "the first";
  EXPECT_FALSE(drawn(false, false));
  EXPECT_EQ(drawn(false, true), size);
  EXPECT_FALSE(drawn(false, true));
  EXPECT_EQ(drawn(true, true), size);
  EXPECT_FALSE(drawn(false, false));
}

TEST_F(CanvasTest, DrawsMovingPicturesCoarselyOnlyIfTheyAreSlow) {
  EXPECT_EQ(drawn(true, false), size);
  let_it_be_slow();
  EXPECT_EQ(drawn(true, false), glm::ivec2(0.55f * glm::vec2(size)));
  EXPECT_EQ(canvas_.render_scale(), 0.55f);
  EXPECT_EQ(drawn(false, true), size) << "and fine when they stand still";
  EXPECT_EQ(canvas_.render_scale(), 1);
  const engine::Image picture = canvas_.read();
  EXPECT_EQ(picture.width, size.x);
  EXPECT_EQ(picture.height, size.y);
  EXPECT_EQ(picture.at(32, 24), glm::u8vec4(0, 255, 0, 255));
}

TEST_F(CanvasTest, IgnoresThePaceOfStillPictures) {
  EXPECT_TRUE(drawn(true, true));
  let_it_be_slow();
  EXPECT_EQ(drawn(true, false), size);
  EXPECT_FALSE(drawn(false, false));
  let_it_be_slow();
  EXPECT_EQ(drawn(true, false), size);
}

TEST_F(CanvasTest, DrawsEachPictureFineWithAGraphicsCard) {
  canvas_ = render::Canvas(false);
  EXPECT_EQ(drawn(true, false), size);
  let_it_be_slow();
  EXPECT_EQ(drawn(true, false), size);
  EXPECT_FALSE(drawn(false, true)) << "it is fine already";
}

}  // namespace THIS_FILE
}  // namespace app
