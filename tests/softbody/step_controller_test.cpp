#include "softbody/integrate/step_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace softbody::test {
namespace {

constexpr double frame = 1.0 / 60;  // s

/// Bounds of a body that bears explicit steps of `stable_step` s, and deforms at `deformation_rate` 1/s.
SubstepBound bound(double stable_step, double deformation_rate = 0) {
  return {stable_step, 1, deformation_rate, 1 / stable_step};
}

StepController with(const char* integrator, std::size_t particles = 1000) {
  StepController steps;
  steps.set_integrator(*find_integrator(integrator));
  steps.begin_frame(frame, particles);
  return steps;
}

TEST(StepController, DividesAFrameIntoStableSubsteps) {
  StepController steps = with("semi-implicit-euler");
  EXPECT_EQ(steps.stable_substeps(bound(frame / 7.5), frame), 8);
  EXPECT_EQ(steps.stable_substeps(bound(frame / 7.5), frame / 2), 4) << "half of it is left";
  EXPECT_EQ(steps.stable_substeps(bound(frame / 7.5, 20 / frame), frame), 20) << "it deforms fast";
  EXPECT_EQ(steps.substeps(8, 30 / frame, frame), 30) << "contacts ask for more";
}

TEST(StepController, KeepsTheRateForAWhile) {
  StepController steps = with("semi-implicit-euler");
  EXPECT_EQ(steps.stable_substeps(bound(frame / 100), frame), 100);
  double after = 0;  // s, for which 100 substeps are kept although 10 are stable
  for (; after < 3; after += frame) {
    steps.begin_frame(frame, 1000);
    if (steps.stable_substeps(bound(frame / 10), frame) < 100) break;
  }
  EXPECT_GE(after, 0.5 - frame);
  EXPECT_LE(after, 1 + frame);
}

TEST(StepController, TakesImplicitStepsOfFewLengths) {
  StepController steps = with("implicit");
  for (const int stable : {1, 3, 5, 9, 100}) {
    const int count = steps.substeps(stable, 0, frame);
    EXPECT_GE(count, stable);
    EXPECT_EQ(count & (count - 1), 0) << "a power of two";
  }
  EXPECT_EQ(steps.substeps(3, 0, 0.75 * frame), 3) << "three quarters are left: quarters of a frame";
}

TEST(StepController, ChoosesTheCheaperIntegrator) {
  StepController steps = with("auto");
  ASSERT_TRUE(steps.automatic());
  steps.choose(bound(frame / 100), {});
  EXPECT_FALSE(steps.integrator().implicit);
  EXPECT_FALSE(steps.why().empty());
  steps = with("auto");
  steps.choose(bound(frame / 200), {});
  EXPECT_TRUE(steps.integrator().implicit) << "in free flight a step is worth 150 substeps";
  steps = with("auto");
  steps.choose(bound(frame / 200), {.near_solids = true});
  EXPECT_FALSE(steps.integrator().implicit) << "on solids it is worth 300";
  steps = with("auto");
  steps.choose(bound(frame / 1500), {.near_solids = true, .penalty_pairs = true});
  EXPECT_FALSE(steps.integrator().implicit) << "in a heap, more";
  steps = with("auto");
  steps.choose(bound(frame / 100), {.rounding_velocity = 0.1, .sleep_speed = 0.05});
  EXPECT_TRUE(steps.integrator().implicit) << "rounding would keep it trembling";
}

TEST(StepController, TakesNoImplicitStepsWhereThereCanBeNone) {
  for (const FrameConditions& c : {FrameConditions{.surface_contact = true}, FrameConditions{.too_large = true}}) {
    StepController steps = with("auto");
    steps.choose(bound(frame / 3000), c);
    EXPECT_FALSE(steps.integrator().implicit);
  }
}

TEST(StepController, EndsAFrameWhoseWorkIsSpent) {
  StepController steps = with("semi-implicit-euler");
  EXPECT_TRUE(steps.may_go_on(10));
  EXPECT_FALSE(steps.may_go_on(steps.max_substeps()));
  for (const FrameWork& work : {FrameWork{.surface = 2e7}, FrameWork{.implicit = 4e6}, FrameWork{.penalty = 1e7}}) {
    steps.begin_frame(frame, 1000);
    ASSERT_TRUE(steps.may_go_on(10));
    steps.spend(work);
    EXPECT_FALSE(steps.may_go_on(10));
    steps.begin_frame(frame, 100'000);
    steps.spend(work);
    EXPECT_TRUE(steps.may_go_on(10)) << "a larger world may do more";
  }
}

TEST(StepController, DoesWhatIsFixedWhateverItCosts) {
  StepController steps = with("xpbd");
  steps.set_fixed_steps(3);
  EXPECT_EQ(steps.max_substeps(), 60) << "20 substeps a step";
  steps.spend({.surface = 1e12, .implicit = 1e12, .penalty = 1e12});
  EXPECT_TRUE(steps.may_go_on(59));
  EXPECT_FALSE(steps.may_go_on(60));
}

TEST(CountSubsteps, CountsSomeEvenForBoundsOutOfReach) {
  EXPECT_EQ(count_substeps(bound(std::numeric_limits<double>::infinity()), frame, 1), 1);
  EXPECT_EQ(count_substeps(bound(1e-300), frame, 1), 1'000'000'000);
}

}  // namespace
}  // namespace softbody::test
