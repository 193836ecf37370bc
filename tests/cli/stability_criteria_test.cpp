// The criteria of `report stability` on invented runs: each passes what is right and fails what is not.

#include "app/reference/stability_criteria.h"

#include <gtest/gtest.h>

#include <limits>

namespace app::test {
namespace THIS_FILE {

constexpr reference::StabilityLimits limits{.seconds = 1, .radius = 0.5};

/// Returns the figures of sixty frames without faults, after `change` has changed each frame.
template <class Change>
reference::StabilityFigures run(Change change, const reference::StabilityLimits& l = limits) {
  reference::StabilityFigures f;
  for (int frame = 1; frame <= 60 && !f.diverged(); ++frame) {
    reference::StabilitySample s{.time = frame / 60.0,
                                 .frame = frame,
                                 .excess = 0,
                                 .scale = 20,
                                 .speed = 3,
                                 .reachable_speed = 10,
                                 .extent = 1,
                                 .reachable_extent = 4};
    change(s);
    f.add(s, l);
  }
  f.reference = reference::ReferenceDeviation{.shape = 0.001, .volume = 0.002, .rest = 1e-4};
  return f;
}

std::string fault(const reference::StabilityFigures& f) {
  std::string all;
  for (const std::string& text : reference::failures(f)) all += text + ";";
  return all;
}

template <class Change>
std::string fault(Change change, const reference::StabilityLimits& l = limits) {
  return fault(run(change, l));
}

TEST(StabilityCriteria, PassARunWithoutFaults) {
  EXPECT_EQ(fault([](reference::StabilitySample&) {}), "");
}

TEST(StabilityCriteria, FailAndEndARunThatIsNotFinite) {
  const reference::StabilityFigures f = run([](reference::StabilitySample& s) { s.finite = s.frame < 30; });
  EXPECT_EQ(fault(f), "not finite;gave up at 0.5 s;");
  EXPECT_EQ(f.blow_up_time, 0.5);
}

TEST(StabilityCriteria, FailAFigureThatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault([&](reference::StabilitySample& s) { s.excess = nan; }), "not finite;gave up at 0.0167 s;");
  EXPECT_EQ(fault([](reference::StabilitySample& s) { s.speed = s.reachable_speed = 0; }),
            "not finite;gave up at 0.0167 s;");
  EXPECT_EQ(fault([&](reference::StabilitySample& s) { s.reachable_extent = nan; }), "not finite;gave up at 0.0167 s;");
  EXPECT_EQ(fault([&](reference::StabilitySample& s) { s.depth = nan; }), "not finite;gave up at 0.0167 s;");
  EXPECT_EQ(fault([](reference::StabilitySample& s) { s.excess = 0, s.scale = 0; }), "not finite;gave up at 0.0167 s;");
}

TEST(StabilityCriteria, AllowAShareOfTheScaleFromNowhere) {
  EXPECT_EQ(fault([](reference::StabilitySample& s) { s.excess = 0.9; }), "");
  EXPECT_EQ(fault([](reference::StabilitySample& s) { s.excess = s.frame == 7 ? 1.1 : 0; }), "energy + 0.055;")
      << "one frame is enough";
}

TEST(StabilityCriteria, GiveUpARunWithTenTimesTheScaleInExcess) {
  const reference::StabilityFigures f = run([](reference::StabilitySample& s) { s.excess = s.frame < 12 ? 0 : 300; });
  EXPECT_EQ(f.blow_up_time, 0.2);
  EXPECT_EQ(fault(f), "energy + 15;gave up at 0.2 s;") << "it is not compared with the reference";
}

TEST(StabilityCriteria, FailSpeedsAndBoxesOutOfReach) {
  EXPECT_EQ(fault([](reference::StabilitySample& s) { s.speed = 9.9, s.extent = 3.9; }), "");
  EXPECT_EQ(fault([](reference::StabilitySample& s) { s.speed = s.frame == 3 ? 20 : 1; }),
            "speed 2 of what energy can give;");
  EXPECT_EQ(fault([](reference::StabilitySample& s) { s.extent = s.frame == 3 ? 6 : 1; }),
            "box 1.5 of what energy can draw;");
}

TEST(StabilityCriteria, AllowAHitToGoDeeperThanRest) {
  EXPECT_EQ(fault([](reference::StabilitySample& s) { s.depth = s.frame == 20 ? 0.049 : 0.009; }), "");
  EXPECT_EQ(fault([](reference::StabilitySample& s) { s.depth = s.frame == 20 ? 0.06 : 0; }),
            "0.12 R deep in a solid;");
  EXPECT_EQ(fault([](reference::StabilitySample& s) { s.depth = s.frame == 55 ? 0.02 : 0; }),
            "0.04 R deep in a solid in the end;");
}

TEST(StabilityCriteria, GiveABodyThatBeginsInsideTenFramesToComeOut) {
  reference::StabilityLimits inside = limits;
  inside.begins_inside = true;
  const auto out_after = [](int frames) {
    return [frames](reference::StabilitySample& s) { s.depth = s.frame <= frames ? 0.2 : 0; };
  };
  EXPECT_EQ(fault(out_after(10), inside), "");
  EXPECT_EQ(fault(out_after(11), inside), "0.4 R deep in a solid;");
  EXPECT_EQ(fault(out_after(10)), "0.4 R deep in a solid;") << "a body that begins outside has no time";
}

TEST(StabilityCriteria, FailABodyThatGoesThroughASolid) {
  EXPECT_EQ(fault([](reference::StabilitySample& s) { s.passed_through = s.frame > 40; }), "through a solid: 1;");
}

TEST(StabilityCriteria, CompareTheEndWithTheReference) {
  reference::StabilityFigures f = run([](reference::StabilitySample&) {});
  f.reference = reference::ReferenceDeviation{.shape = 0.02, .volume = 0.03, .rest = 0.004};
  EXPECT_EQ(fault(f), "shape off by 0.02 R;volume off by 3 %;moves by 0.004 m/s too fast;");
  f.reference.reset();
  EXPECT_EQ(fault(f), "") << "without a reference the other figures decide";
}

TEST(StabilityCriteria, FailARefusedRun) {
  EXPECT_EQ(fault(reference::StabilityFigures{.refused = "too stiff"}), "refused: too stiff;");
}

}  // namespace THIS_FILE
}  // namespace app::test
