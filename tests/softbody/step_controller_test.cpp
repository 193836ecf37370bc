#include "softbody/integrate/step_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace softbody::test {
namespace THIS_FILE {

constexpr double frame = 1.0 / 60;  // s
constexpr FrameConditions ball{.seconds = frame, .particles = 1000, .moving = 1000};

/// The bound of bodies that need `count` explicit substeps a frame.
StepBound stable(double count) { return {.stable = count / frame}; }

StepController with(const char* integrator, std::optional<int> substeps = {}) {
  StepController steps;
  steps.set_choice({integrator, substeps});
  return steps;
}

/// Returns the substeps of a frame that begins with this bound.
double substeps(StepController& steps, const StepBound& bound, const FrameConditions& conditions = ball) {
  steps.begin_frame(conditions, bound);
  return steps.plan(bound, conditions.seconds).substeps;
}

double first_substeps(const char* integrator, const StepBound& bound) {
  StepController steps = with(integrator);
  return substeps(steps, bound);
}

TEST(StepController, DividesAFrameIntoStableSubsteps) {
  for (const char* integrator : {"semi-implicit-euler", "rk4", "auto"}) {
    EXPECT_EQ(first_substeps(integrator, stable(0.1)), 1);
    EXPECT_EQ(first_substeps(integrator, stable(7.5)), 8);
    EXPECT_EQ(first_substeps(integrator, {.stable = 7.5 / frame, .deformation = 20 / frame}), 20) << "it deforms fast";
    EXPECT_EQ(first_substeps(integrator, {.stable = 7.5 / frame, .passing = 30 / frame}), 30) << "it passes fast";
  }
}

TEST(StepController, TakesNoStepLongerThanASixtiethOfASecondUnlessFixed) {
  FrameConditions half_a_second = ball;
  half_a_second.seconds = 0.5;
  for (const char* integrator : {"semi-implicit-euler", "implicit", "xpbd"}) {
    StepController free = with(integrator), fixed = with(integrator, 1);
    EXPECT_EQ(substeps(free, {}, half_a_second), integrator == std::string_view("implicit") ? 32 : 30) << integrator;
    EXPECT_EQ(substeps(fixed, {}, half_a_second), fixed.bounds_of().substeps_per_step) << integrator;
  }
}

/// A body does not stay round where a step bends it by more than its radius.
TEST(StepController, TakesImplicitStepsThatABodyStaysRoundIn) {
  EXPECT_EQ(first_substeps("implicit", {.deformation = 30 / frame}), 4) << "3 of the ladder";
  EXPECT_EQ(first_substeps("implicit", {.deformation = 1e4 / frame}), 16);
}

/// Contact of surfaces acts after an implicit solve.
TEST(StepController, TakesShortImplicitStepsWhereSurfacesMayTouch) {
  const StepBound bound{.surfaces_near = true};
  EXPECT_EQ(first_substeps("implicit", bound), 8);
  EXPECT_EQ(first_substeps("implicit", {}), 1);
  for (const char* other : {"semi-implicit-euler", "imex-euler", "xpbd"})
    EXPECT_EQ(first_substeps(other, bound), first_substeps(other, {})) << other;
}

TEST(StepController, TakesFewLengths) {
  for (const Integrator& i : integrators()) {
    std::set<int> taken;
    int last = 0;
    for (double count = 32.5; count <= 1024; count += 0.5) {
      const int now = first_substeps(i.key.data(), {.stable = 0, .passing = count / frame});
      EXPECT_GE(now, count);
      EXPECT_LT(now, count + count / i.step_lengths + 1);
      EXPECT_GE(now, last);
      taken.insert(last = now);
    }
    EXPECT_EQ(taken.size(), 5u * unsigned(i.step_lengths)) << i.key;
  }
}

TEST(StepController, DividesTheRestOfAFrame) {
  const auto rest = [](const char* integrator, double passing, double left) {
    const StepBound bound{.passing = passing / frame};
    StepController steps = with(integrator);
    steps.begin_frame(ball, bound);
    return steps.plan(bound, left * frame).substeps;
  };
  for (const char* integrator : {"semi-implicit-euler", "implicit"}) {
    EXPECT_EQ(rest(integrator, 4, 0.75), 3);
    EXPECT_EQ(rest(integrator, 1, 0.25), 1);
    EXPECT_EQ(rest(integrator, 8, 0.625), 5);
  }
  EXPECT_EQ(rest("semi-implicit-euler", 5, 0.75), 4);
  EXPECT_EQ(rest("implicit", 5, 0.75), 6) << "eighths of a frame";
  EXPECT_EQ(rest("semi-implicit-euler", 2, 0.625), 2);
  EXPECT_EQ(rest("implicit", 2, 0.625), 5) << "eighths do not make up halves";
}

TEST(StepController, KeepsTheRateForAWhile) {
  StepController steps = with("semi-implicit-euler");
  const int before = substeps(steps, stable(100));
  double after = 0;  // s, for which the substeps are kept although fewer are stable
  while (after < 3 && substeps(steps, stable(10)) == before) after += frame;
  EXPECT_GE(after, 0.5 - frame);
  EXPECT_LE(after, 1 + frame);
}

TEST(StepController, ForgetsTheRateWhileNothingMoves) {
  StepController steps = with("semi-implicit-euler");
  substeps(steps, stable(100));
  for (int i = 0; i < 62; ++i) steps.begin_frame({.seconds = frame, .particles = 1000}, {});
  EXPECT_LT(substeps(steps, stable(10)), 20);
}

/// One that no number of substeps carries must not have the next frames cut short, too.
TEST(StepController, KeepsNoRateThatIsBeyondTheBudget) {
  StepController steps = with("semi-implicit-euler");
  substeps(steps, stable(1e9));
  const int kept = substeps(steps, stable(10));
  EXPECT_LE(kept * steps.work_of_substep(), 1.2 * WorkBudget{}.of(ball.particles));
}

TEST(StepController, ChoosesTheCheaperIntegrator) {
  const auto implicit = [](double count, const FrameConditions& conditions, double deformation = 0) {
    StepController steps = with("auto");
    const StepBound bound{.stable = count / frame, .deformation = deformation / frame};
    steps.begin_frame(conditions, bound);
    EXPECT_FALSE(steps.plan(bound, frame).why.empty());
    return steps.plan().integrator->implicit;
  };
  FrameConditions c = ball;
  EXPECT_FALSE(implicit(100, c));
  EXPECT_TRUE(implicit(200, c)) << "in free flight a step is worth 150 substeps";
  EXPECT_FALSE(implicit(200, c, 15)) << "two of them more";
  c.near_solids = true;
  EXPECT_FALSE(implicit(200, c)) << "on solids it is worth 300";
  EXPECT_TRUE(implicit(400, c));
  c.penalty_pairs = 1;
  EXPECT_FALSE(implicit(1500, c)) << "in a heap, more";
  EXPECT_TRUE(implicit(1e12, c)) << "whatever explicit substeps would take";
  c = ball;
  c.rounding = 1e-5, c.sleep_speed = 0.05;
  EXPECT_TRUE(implicit(100, c)) << "rounding would keep it trembling";
  for (bool FrameConditions::*none : {&FrameConditions::surface_contact, &FrameConditions::too_large}) {
    c = ball;
    c.*none = true;
    EXPECT_FALSE(implicit(1e12, c));
  }
}

/// Else a body that swings would be moved in another way with every swing.
TEST(StepController, ChoosesByTheRateThatItKeeps) {
  StepController steps = with("auto");
  for (const int count : {200, 100}) {
    substeps(steps, stable(count));
    EXPECT_TRUE(steps.plan().integrator->implicit) << count;
  }
  for (int i = 0; i < 62; ++i) substeps(steps, stable(100));
  EXPECT_FALSE(steps.plan().integrator->implicit);
}

TEST(StepController, ChoosesImplicitStepsIfTheFixedOnesWouldBeUnstable) {
  for (const int count : {10, 1000}) {
    StepController steps = with("auto", count);
    EXPECT_EQ(substeps(steps, stable(100)), count);
    EXPECT_EQ(steps.plan().integrator->implicit, count < 100);
  }
}

TEST(StepController, ChoosesNothingWhileNothingMoves) {
  StepController steps = with("auto");
  steps.begin_frame({.seconds = frame, .particles = 1000}, {});
  EXPECT_TRUE(steps.plan().integrator->automatic);
  EXPECT_EQ(steps.plan().needed, 0);
}

TEST(StepController, SaysHowManyTheBoundsAskFor) {
  StepController steps = with("semi-implicit-euler");
  substeps(steps, stable(100));
  EXPECT_EQ(steps.plan().needed, 100);
  substeps(steps, stable(10));
  EXPECT_EQ(steps.plan().needed, 10) << "not those of the kept rate";
  steps.plan({.stable = 10 / frame, .passing = 50 / frame}, frame / 2);
  EXPECT_EQ(steps.plan().needed, 50) << "by the last bound, of a whole frame";
  steps = with("implicit");
  substeps(steps, {.stable = 100 / frame, .passing = 3 / frame});
  EXPECT_EQ(steps.plan().needed, 3);
}

TEST(StepController, EndsAFrameThatHasSpentItsBudget) {
  StepController steps = with("semi-implicit-euler");
  const double budget = WorkBudget{}.of(ball.particles);
  substeps(steps, stable(10));
  EXPECT_TRUE(steps.may_go_on());
  steps.spend(0.9 * budget);
  EXPECT_TRUE(steps.may_go_on());
  steps.spend(0.2 * budget);
  EXPECT_FALSE(steps.may_go_on());
  substeps(steps, stable(10));
  EXPECT_TRUE(steps.may_go_on()) << "the next frame has its own";
  steps.set_budget({.least = 10});
  steps.begin_frame(ball, stable(10));
  steps.spend(20);
  EXPECT_TRUE(steps.may_go_on()) << "a larger world may do more";
}

TEST(StepController, DoesWhatIsFixedWhateverItCosts) {
  for (const Integrator& i : integrators()) {
    StepController steps = with(i.key.data(), 3);
    EXPECT_EQ(substeps(steps, stable(2)), 3 * i.substeps_per_step) << i.key;
    EXPECT_EQ(substeps(steps, {1e300, 1e300, 1e300}), 3 * steps.plan().integrator->substeps_per_step) << i.key;
    EXPECT_EQ(steps.plan({1e300, 1e300, 1e300}, frame / 3).substeps, steps.plan().integrator->substeps_per_step);
    steps.spend(1e300);
    EXPECT_TRUE(steps.may_go_on());
  }
}

TEST(StepController, TakesGasImplicitlyWhereItAloneAsksForShortSteps) {
  constexpr StepBound gas{.stable = 300, .breathing = 2000};
  const auto chosen = [](const StepBound& bound, bool surfaces_touch = false) {
    StepController steps = with("auto");
    FrameConditions conditions = ball;
    conditions.surfaces_touch = surfaces_touch;
    steps.begin_frame(conditions, bound);
    return steps.plan().integrator->key;
  };
  EXPECT_EQ(chosen(gas), "imex-euler");
  EXPECT_EQ(chosen({.stable = 1900, .breathing = 2000}), "semi-implicit-euler") << "springs are as stiff";
  EXPECT_EQ(chosen({.stable = 100, .breathing = 500}), "semi-implicit-euler") << "accuracy asks for as many steps";
  EXPECT_EQ(chosen(gas, true), "semi-implicit-euler");
}

TEST(StepController, TakesGasExplicitlyForHalfASecondAfterAVolumeChanged) {
  constexpr StepBound still{.stable = 300, .breathing = 2000};
  StepBound swollen = still;
  swollen.volume_change = 0.1;
  StepController steps = with("auto");
  const auto chosen = [&](const StepBound& bound) {
    steps.begin_frame(ball, bound);
    return steps.plan().integrator->key;
  };
  EXPECT_EQ(chosen(swollen), "semi-implicit-euler");
  for (int i = 0; i < 28; ++i) EXPECT_EQ(chosen(still), "semi-implicit-euler") << "frame " << i;
  for (int i = 0; i < 32; ++i) chosen(still);
  EXPECT_EQ(chosen(still), "imex-euler");
}

TEST(StepController, PlansSomeStepsEvenForBoundsOutOfReach) {
  constexpr double infinite = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
  for (const Integrator& i : integrators())
    for (const double rate : {1e300, infinite, none}) {
      StepController steps = with(i.key.data());
      const StepBound bound{rate, rate, rate};
      EXPECT_GT(substeps(steps, bound), 0) << i.key;
      EXPECT_GT(steps.plan(bound, frame / 3).substeps, 0) << i.key;
      EXPECT_GE(steps.plan().needed, 1);
    }
}

TEST(WorkBudget, GrowsWithTheWorldAndIsSmallerInAWindow) {
  const WorkBudget budget;
  EXPECT_EQ(budget.of(1), budget.of(1000));
  EXPECT_DOUBLE_EQ(budget.of(2'000'000), 2 * budget.of(1'000'000));
  for (const std::size_t particles : {1u, 10'000u, 100'000u, 4'000'000u})
    EXPECT_LT(window_budget.of(particles), budget.of(particles));
}

/// Of 96 bytes each: what a world may hold must not grow beyond what a machine does.
TEST(MaxCandidates, AreMoreInLargerWorldsUpToALimit) {
  const MaxCandidates max;
  EXPECT_EQ(max.of(1000), std::size_t{1} << 24);
  EXPECT_EQ(max.of(400'000), 64u * 400'000);
  EXPECT_EQ(max.of(4'000'000), std::size_t{1} << 25);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
