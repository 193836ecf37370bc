#include <gtest/gtest.h>

#include <optional>
#include <thread>

#include "app/render/canvas.h"
#include "app/window/frame_timer.h"
#include "engine/headless.h"

namespace app {
namespace {

/// Pictures that take `fixed` s to draw whatever their size, `pixels` s with all their pixels, and `other` s besides.
struct Cost {
  double fixed, pixels, other;
  void draw(Fineness& fineness) const {
    const double drawing = fixed + pixels * double(fineness.value()) * double(fineness.value());
    fineness.add(drawing + other, drawing);
  }
};

float after(int pictures, Fineness& fineness, const Cost& cost) {
  for (int i = 0; i < pictures; ++i) cost.draw(fineness);
  return fineness.value();
}

TEST(FrameTimer, WaitsAfterASecondWithoutActivity) {
  FrameTimer timer;
  timer.tick();
  EXPECT_EQ(timer.idle_wait(), 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  double longest = 0;
  for (int i = 0; i < 100 && longest == 0; ++i) {  // a busy machine may use up the time to wait
    timer.tick();
    longest = std::max(longest, timer.idle_wait());
  }
  EXPECT_GT(longest, 0);
  EXPECT_LE(longest, 1.0 / 30);
  timer.mark_active();
  EXPECT_EQ(timer.idle_wait(), 0);
}

TEST(Fineness, IsLessWhereDrawingTakesTooLong) {
  Fineness fineness;
  EXPECT_EQ(fineness.value(), 1);
  EXPECT_EQ(after(200, fineness, {0.005, 0.020, 0.005}), 1);
  EXPECT_EQ(after(200, fineness, {0.005, 0.030, 0.005}), 0.8f);
  EXPECT_EQ(after(200, fineness, {0.010, 0.080, 0.005}), 0.55f);
  EXPECT_EQ(after(200, fineness, {0.001, 0.004, 0.025}), 1) << "it comes back";
}

TEST(Fineness, StaysThoughAScreenOfSixtyHertzIsMissedNowAndThen) {
  Fineness fineness;
  for (int i = 0; i < 400; ++i) fineness.add(i % 36 == 7 ? 3.0 / 60 : 2.0 / 60, 0.025);
  EXPECT_EQ(fineness.value(), 1);
  for (int i = 0; i < 400; ++i) fineness.add(i % 9 == 7 ? 3.0 / 60 : 2.0 / 60, 0.025);
  EXPECT_LT(fineness.value(), 1) << "not if that is the rule";
}

TEST(Fineness, DoesNotPayForWhatElseIsSlow) {
  Fineness fineness;
  EXPECT_EQ(after(200, fineness, {0.005, 0.015, 0.050}), 1);
}

TEST(Fineness, SettlesWhateverPicturesCost) {
  for (double fixed = 0.001; fixed < 0.06; fixed *= 1.3)
    for (double pixels = 0.001; pixels < 0.2; pixels *= 1.3)
      for (const double other : {0.001, 0.01, 0.03}) {
        const Cost cost{fixed, pixels, other};
        Fineness fineness;
        const float settled = after(200, fineness, cost);
        for (int i = 0; i < 100; ++i)
          ASSERT_EQ(after(1, fineness, cost), settled) << fixed << " " << pixels << " " << other;
      }
}

class CanvasTest : public testing::Test {
 protected:
  static constexpr glm::ivec2 size{64, 48};

  /// What it was told to draw into; nothing: not at all.
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
    for (int i = 0; i < 200; ++i) canvas_.pace(0.1, 0.09);
  }

  engine::HeadlessContext context_;  // first: the canvas needs it
  Canvas canvas_{true};
};

TEST_F(CanvasTest, DrawsWhatChangedOnceAndFineOnce) {
  EXPECT_EQ(drawn(false, false), size) << "the first";
  EXPECT_FALSE(drawn(false, false));
  EXPECT_EQ(drawn(false, true), size);
  EXPECT_FALSE(drawn(false, true));
  EXPECT_EQ(drawn(true, true), size);
  EXPECT_FALSE(drawn(false, false));
}

TEST_F(CanvasTest, MovingPicturesAreCoarseOnlyWhereTheyComeTooSlowly) {
  EXPECT_EQ(drawn(true, false), size);
  let_it_be_slow();
  EXPECT_EQ(drawn(true, false), glm::ivec2(0.55f * glm::vec2(size)));
  EXPECT_EQ(canvas_.fineness(), 0.55f);
  EXPECT_EQ(drawn(false, true), size) << "and fine when they stand still";
  EXPECT_EQ(canvas_.fineness(), 1);
  const engine::Image picture = canvas_.read();
  EXPECT_EQ(picture.width, size.x);
  EXPECT_EQ(picture.height, size.y);
  EXPECT_EQ(picture.at(32, 24), glm::u8vec4(0, 255, 0, 255));
}

TEST_F(CanvasTest, StillPicturesSayNothingOfThePace) {
  EXPECT_TRUE(drawn(true, true));
  let_it_be_slow();
  EXPECT_EQ(drawn(true, false), size);
  EXPECT_FALSE(drawn(false, false));
  let_it_be_slow();
  EXPECT_EQ(drawn(true, false), size);
}

TEST_F(CanvasTest, WithAGraphicsCardEveryPictureIsFine) {
  canvas_ = Canvas(false);
  EXPECT_EQ(drawn(true, false), size);
  let_it_be_slow();
  EXPECT_EQ(drawn(true, false), size);
  EXPECT_FALSE(drawn(false, true)) << "it is that already";
}

}  // namespace
}  // namespace app
