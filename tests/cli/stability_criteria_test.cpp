// The criteria of `report stability` on invented runs: each passes what is right and fails what is not.

#include "app/reference/stability_criteria.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace app::test {
namespace THIS_FILE {

using Sample = reference::StabilitySample;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Returns the figures of sixty frames without faults, after `change` has changed each frame.
reference::StabilityFigures run(void (*change)(Sample&), bool begins_inside = false) {
  const reference::StabilityLimits limits{.seconds = 1, .radius = 0.5, .begins_inside = begins_inside};
  reference::StabilityFigures f;
  for (int frame = 1; frame <= 60 && !f.diverged(); ++frame) {
    Sample s{.time = frame / 60.0, .frame = frame, .speed = 0.3, .extent = 0.25};
    change(s);
    f.add(s, limits);
  }
  f.reference = reference::ReferenceDeviation{.shape = 0.001, .volume = 0.002, .rest = 1e-4};
  return f;
}

std::string fault(const reference::StabilityFigures& f) {
  std::string all;
  for (const std::string& text : reference::failures(f)) all += text + ";";
  return all;
}

TEST(StabilityCriteria, PassWhatIsRightAndFailWhatIsNot) {
  struct Case {
    const char* what;
    void (*change)(Sample&);
    std::string fault;
    bool begins_inside = false;
  };
  const std::string at_once = "not finite;gave up at 0.0167 s;";
  for (const auto& [what, change, expected, begins_inside] : std::vector<Case>{
           {"no fault", [](Sample&) {}, ""},
           {"not finite", [](Sample& s) { s.finite = s.frame < 30; }, "not finite;gave up at 0.5 s;"},
           {"an excess that is no number", [](Sample& s) { s.excess = nan; }, at_once},
           {"a speed that is no number", [](Sample& s) { s.speed = nan; }, at_once},
           {"an extent that is no number", [](Sample& s) { s.extent = nan; }, at_once},
           {"a depth that is no number", [](Sample& s) { s.depth = nan; }, at_once},
           {"a small excess", [](Sample& s) { s.excess = 0.045; }, ""},
           {"one frame with an excess", [](Sample& s) { s.excess = s.frame == 7 ? 0.055 : 0; }, "energy + 0.055;"},
           {"ten times the scale, without a comparison with the reference",
            [](Sample& s) { s.excess = s.frame < 12 ? 0 : 15; }, "energy + 15;gave up at 0.2 s;"},
           {"within reach", [](Sample& s) { s.speed = 0.99, s.extent = 0.98; }, ""},
           {"too fast", [](Sample& s) { s.speed = s.frame == 3 ? 2 : 0.1; }, "speed 2 of what energy can give;"},
           {"too long", [](Sample& s) { s.extent = s.frame == 3 ? 1.5 : 0.25; }, "box 1.5 of what energy can draw;"},
           {"a hit deeper than at rest", [](Sample& s) { s.depth = s.frame == 20 ? 0.049 : 0.009; }, ""},
           {"a hit too deep", [](Sample& s) { s.depth = s.frame == 20 ? 0.06 : 0; }, "0.12 R deep in a solid;"},
           {"too deep at rest", [](Sample& s) { s.depth = s.frame == 55 ? 0.02 : 0; },
            "0.04 R deep in a solid in the end;"},
           {"out in ten frames", [](Sample& s) { s.depth = s.frame <= 10 ? 0.2 : 0; }, "", true},
           {"out later", [](Sample& s) { s.depth = s.frame <= 11 ? 0.2 : 0; }, "0.4 R deep in a solid;", true},
           {"began outside", [](Sample& s) { s.depth = s.frame <= 10 ? 0.2 : 0; }, "0.4 R deep in a solid;"},
           {"through a solid", [](Sample& s) { s.passed_through = s.frame > 40; }, "through a solid: 1;"}})
    EXPECT_EQ(fault(run(change, begins_inside)), expected) << what;
}

TEST(StabilityCriteria, CompareTheEndWithTheReference) {
  reference::StabilityFigures f = run([](Sample&) {});
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
