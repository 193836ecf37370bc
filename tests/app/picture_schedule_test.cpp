#include "app/window/picture_schedule.h"

#include <gtest/gtest.h>

namespace app {
namespace THIS_FILE {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A loop as the demo's, with a clock of its own. Nothing happens but what the test says.
struct Loop {
  double now = 100;
  window::PictureSchedule schedule{now};
  window::Activity activity;
  bool awaits_answer = false;
  int pictures = 0, wake_ups = 0;

  /// Runs for so long (s). A picture takes 1/60 s.
  void run(double seconds) {
    pictures = wake_ups = 0;
    for (const double end = now + seconds; now < end; ++wake_ups) {
      now += schedule.wait(now, awaits_answer);
      if (!schedule.due(now)) continue;
      ++pictures;
      now += 1.0 / 60;
      schedule.drawn(now, activity);
    }
  }
};

TEST(SecondsToNextPicture, AreThoseOfTheMostUrgent) {
  EXPECT_EQ(window::seconds_to_next_picture({}), infinity);
  EXPECT_EQ(window::seconds_to_next_picture({.next_change = 3}), 3);
  EXPECT_EQ(window::seconds_to_next_picture({.typing = true, .next_change = 3}), 0.4);
  EXPECT_EQ(window::seconds_to_next_picture({.typing = true, .next_change = 0.1}), 0.1);
  EXPECT_EQ(window::seconds_to_next_picture({.reporting = true, .typing = true}), 0.25);
  EXPECT_EQ(window::seconds_to_next_picture({.counting = true, .reporting = true}), 1.0 / 30);
  EXPECT_EQ(window::seconds_to_next_picture({.moving = true, .counting = true, .next_change = 3}), 0);
  EXPECT_EQ(window::seconds_to_next_picture({.next_change = -1}), 0) << "it should be gone already";
}

TEST(PictureSchedule, DrawsAsOftenAsTheActivityAsksForAfterTheFirstSecond) {
  struct Row {
    window::Activity activity;
    int pictures, tolerance;  // of ten seconds
  };
  // Beside a wait of 1/30 s or 0.4 s a picture takes 1/60 s.
  for (const Row& row :
       {Row{{}, 0, 0}, Row{{.moving = true}, 600, 2}, Row{{.counting = true}, 200, 5}, Row{{.typing = true}, 24, 1}}) {
    Loop loop;
    loop.activity = row.activity;
    loop.run(2);
    EXPECT_GT(loop.pictures, 55) << "for a second after the start";
    loop.run(10);
    EXPECT_NEAR(loop.pictures, row.pictures, row.tolerance);
  }
}

TEST(PictureSchedule, DrawsNothingButWakesUpOnceNothingChanges) {
  Loop loop;
  loop.activity.moving = true;
  loop.run(10);
  loop.activity.moving = false;
  loop.run(3);
  EXPECT_NEAR(loop.pictures, 60, 2) << "for a second longer";
  loop.run(100);
  EXPECT_EQ(loop.pictures, 0);
  EXPECT_LE(loop.wake_ups, 401) << "a few times a second it looks whether anything has changed";
}

TEST(PictureSchedule, DrawsAtOnceAfterInputAndForASecond) {
  Loop loop;
  loop.run(3);
  loop.schedule.input(loop.now);
  EXPECT_TRUE(loop.schedule.due(loop.now));
  EXPECT_EQ(loop.schedule.wait(loop.now, false), 0);
  loop.run(3);
  EXPECT_NEAR(loop.pictures, 60, 2) << "a tooltip has time to appear";
}

TEST(PictureSchedule, DrawsOnceWhenAHintGoes) {
  Loop loop;
  loop.run(2);
  loop.schedule.input(loop.now);
  loop.run(1.5);
  loop.schedule.drawn(loop.now, {.next_change = 7.3});
  loop.run(7);
  EXPECT_EQ(loop.pictures, 0);
  loop.run(1);
  EXPECT_EQ(loop.pictures, 1);
}

TEST(PictureSchedule, LooksMoreOftenForAnAnswerWithoutDrawing) {
  Loop loop;
  loop.awaits_answer = true;
  loop.run(2);
  loop.run(10);
  EXPECT_EQ(loop.pictures, 0);
  EXPECT_NEAR(loop.wake_ups, 300, 2);
}

}  // namespace THIS_FILE
}  // namespace app
