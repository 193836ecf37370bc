#include "app/session/live/live_comparison.h"

#include <gtest/gtest.h>

#include "softbody/world/world.h"
#include "tests/app/scenes.h"
#include "tests/support/change.h"

namespace app {
namespace THIS_FILE {

/// A comparison beside a world that stands still.
struct Rig {
  softbody::World world{touching_pair(), {}};
  session::LiveComparison comparison;
  std::uint64_t revision = 1;

  Rig() { comparison.restart(world, revision); }

  void change(auto edit) {
    softbody::change(world, edit);
    comparison.detection_changed(world, ++revision);
  }
  /// Exchanges until `done`; false if that takes too long.
  bool wait(auto done) {
    return wait_until([&] {
      comparison.exchange(world, revision, 0, 2);
      return done();
    });
  }
  bool wait_for_recall() {
    return wait([this] { return comparison.report().id == revision; });
  }
};

TEST(LiveComparison, MeasuresTheRecallOfAWorldThatStandsStillAfterEveryChange) {
  Rig rig;
  EXPECT_EQ(rig.comparison.driver_row(), nullptr);
  ASSERT_TRUE(rig.wait_for_recall());
  EXPECT_EQ(rig.comparison.driver_row()->recall, 1.0);
  EXPECT_EQ(rig.comparison.recall().size(), 1u);
  rig.change([](softbody::Scene& s) { s.method = "multi-level-sb"; });
  EXPECT_EQ(rig.comparison.driver_row(), nullptr) << "what is known of another method says nothing of this one";
  EXPECT_EQ(rig.comparison.recall().size(), 0u);
  rig.change([](softbody::Scene& s) {
    s.collision.cell_size = glm::vec3(0.13f);
    s.collision.buckets = 1'000'003;
  });
  ASSERT_TRUE(rig.wait_for_recall());
  EXPECT_LT(rig.comparison.driver_row()->recall, 1.0);
  EXPECT_EQ(rig.comparison.missed(), &rig.comparison.driver_row()->missed);
  rig.comparison.restart(rig.world, ++rig.revision);
  EXPECT_EQ(rig.comparison.report().id, 0u);
  EXPECT_EQ(rig.comparison.missed(), nullptr);
}

TEST(LiveComparison, SumsWhatEachMethodFoundOverAllStatesSinceTheStart) {
  Rig rig;
  rig.comparison.choice.on = true;
  const std::size_t paper = compare::method_index("multi-level-sb");
  const auto sum = [&] { return rig.comparison.sum(paper); };
  const auto next_state = [&] {
    ++rig.revision;
    return rig.wait([&] { return rig.comparison.report().id == rig.revision && rig.comparison.scored_row(paper); });
  };
  rig.change([](softbody::Scene& s) {
    s.collision.cell_size = glm::vec3(0.13f);
    s.collision.buckets = 1'000'003;
  });
  EXPECT_EQ(sum().recall(), 1) << "of no contact";
  std::size_t found = 0, truth = 0;
  for (int states = 1; states <= 3; ++states) {
    rig.world.step();
    ASSERT_TRUE(next_state());
    truth += rig.comparison.report().true_contacts;
    found += rig.comparison.report().true_contacts - rig.comparison.scored_row(paper)->missed.size();
    ASSERT_TRUE(rig.wait([&] { return !rig.comparison.awaits_report(rig.revision); })) << "each state counts once";
    EXPECT_EQ(sum().frames, states);
    EXPECT_EQ(sum().true_contacts - sum().missed, found);
    EXPECT_EQ(sum().true_contacts, truth);
  }
  EXPECT_LT(found, truth);
  rig.change([](softbody::Scene& s) { s.method = "octree"; });
  EXPECT_EQ(sum().frames, 3) << "another driver changes no sum";
  rig.change([](softbody::Scene& s) { s.collision.levels = 2; });
  EXPECT_EQ(sum().frames, 0);
  ASSERT_TRUE(next_state());
  EXPECT_EQ(sum().frames, 1);
  rig.comparison.restart(rig.world, ++rig.revision);
  EXPECT_EQ(sum().frames, 0);
}

TEST(LiveComparison, TimesAllMethodsAgainAndAgainWhileAskedTo) {
  Rig rig;
  rig.comparison.choice.on = true;
  const TimeSeries& times = rig.comparison.method_ms()[compare::method_index("grid-hash")];
  ASSERT_TRUE(rig.wait([&] { return times.size() >= 3; }));
  EXPECT_GT(times.median(15), 0.0f);
  rig.change([](softbody::Scene& s) { s.method = "bounding-box"; });
  EXPECT_GE(times.size(), 3u) << "another driver changes no times";
  rig.change([](softbody::Scene& s) { s.collision.levels = 5; });
  EXPECT_EQ(times.size(), 0u) << "other settings, other times";
}

TEST(LiveComparison, HasNothingMoreToLearnAboutAStateOnceEachMethodWasTimedOften) {
  Rig rig;
  rig.comparison.choice.on = true;
  const TimeSeries& times = rig.comparison.method_ms()[compare::method_index("grid-hash")];
  constexpr auto enough = std::size_t{session::LiveComparison::times_per_state};
  const auto rests = [&] { return !rig.comparison.awaits_report(rig.revision); };
  ASSERT_TRUE(rig.wait(rests));
  EXPECT_EQ(times.size(), enough);
  rig.comparison.choice.methods[compare::method_index("bounding-box")] = true;
  EXPECT_FALSE(rests()) << "other methods were chosen";
  ASSERT_TRUE(rig.wait(rests));
  EXPECT_EQ(times.size(), 2 * enough);
  ++rig.revision;
  EXPECT_FALSE(rests()) << "the world moved";
  ASSERT_TRUE(rig.wait(rests));
  EXPECT_EQ(times.size(), 3 * enough);
  rig.comparison.choice.on = false;
  EXPECT_TRUE(rests());
}

}  // namespace THIS_FILE
}  // namespace app
