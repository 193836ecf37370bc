// What acts once a frame on a body as a whole: internal damping, rolling resistance, rebound damping.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "softbody/integrate/plan.h"
#include "softbody/integrate/resistance.h"
#include "softbody/state/rigid_motion.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

/// One body that wobbles, turns and moves.
class ResistanceOfABody : public testing::Test {
 protected:
  ResistanceOfABody() {
    material[Material::internal_damping] = 5;
    material[contact::rolling_resistance] = 0.1;
    material[contact::rebound_speed] = 4;
    model = batch.model = make_unbalanced_body_model({}, material);
    batch.used = lane + 2;
    batch.moves[lane] = 1;
    x = v = LaneField(model->start.size());
    v.randomise(random, 1);
    for (std::size_t i = 0; i < model->start.size(); ++i) {
      x.set(i, lane, model->start[i]);
      v.set(i, lane,
            glm::dvec3(0, 2, 0) + glm::cross(glm::dvec3(1, 2, 3), model->start[i]) + random_vector(random, 0.1));
    }
  }
  RigidMotion motion() { return rigid_motion(model->start.size(), of(x), of(v)); }
  /// J/kg, of one particle, in all that is not rigid motion.
  double wobble() {
    const RigidMotion m = motion();
    double sum = 0;
    for (std::size_t i = 0; i < model->start.size(); ++i) {
      const glm::dvec3 own = of(v)(i) - m.velocity - glm::cross(m.spin, of(x)(i) - m.centre);
      sum += 0.5 * glm::dot(own, own);
    }
    return sum;
  }
  void apply(Stage stage, const SolidPush& push = {}) { apply(std::vector<Stage>{stage}, push); }
  void apply(const std::vector<Stage>& stages, const SolidPush& push) {
    Resistance resistance;
    resistance.set_plan({stages, {}, {}});
    std::array<SolidPush, lanes> pushes;
    std::array<Impact, lanes> impacts{};
    pushes[lane] = push, impacts[lane] = impact;
    resistance.apply({batch, x.field(), v.field()}, pushes, 0.02, impacts);
    impact = impacts[lane];
  }
  static BodyField of(LaneField& f) { return {f.field(), lane, lanes}; }

  static constexpr int lane = 3;
  std::mt19937 random{7};
  Material material = spring_ball();
  std::shared_ptr<const BodyModel> model;
  Batch batch;
  LaneField x{0}, v{0};
  Impact impact;
};

TEST_F(ResistanceOfABody, ActsOnlyIfThePlanHasIt) {
  const LaneField before = v;
  apply(Stage::gravity, {{0, 1, 0}, 0});
  EXPECT_EQ(v, before);
}

TEST_F(ResistanceOfABody, LeavesOtherLanesThatDoNotMove) {
  const LaneField before = v;
  apply(Stage::internal_damping, {{0, 1, 0}, 0});
  EXPECT_NE(v.at(7, lane), before.at(7, lane));
  for (std::size_t i = 0; i < model->start.size(); ++i)
    for (const int other : {lane - 1, lane + 1}) ASSERT_EQ(v.at(i, other), before.at(i, other));
}

TEST_F(ResistanceOfABody, InternallyDampsAllButRigidMotion) {
  const RigidMotion before = motion();
  const double wobble_before = wobble();
  apply(Stage::internal_damping);
  EXPECT_LT(glm::distance(motion().velocity, before.velocity), 1e-6);
  EXPECT_LT(glm::distance(motion().momentum, before.momentum), 1e-5 * glm::length(before.momentum));
  EXPECT_NEAR(wobble(), wobble_before / (1.1 * 1.1), 1e-4 * wobble_before);  // 5/s for 0.02 s
}

TEST_F(ResistanceOfABody, RollsByTheNormalImpulse) {
  const RigidMotion before = motion();
  apply(Stage::rolling_resistance);
  EXPECT_EQ(motion().momentum, before.momentum) << "nothing touches it";
  apply(Stage::rolling_resistance, {{0, 0.01, 0}, 0});
  const double lost = model->particle_mass * (glm::length(before.momentum) - glm::length(motion().momentum));
  EXPECT_NEAR(lost, 0.1 * model->radius * 0.01, 1e-3 * lost);
  EXPECT_LT(glm::distance(motion().velocity, before.velocity), 1e-6);
  apply(Stage::rolling_resistance, {{0, 1e6, 0}, 0});
  EXPECT_LT(glm::length(motion().momentum), 1e-5 * glm::length(before.momentum)) << "it stops, and does not turn back";
}

TEST_F(ResistanceOfABody, RollsOnIfItIsNotClosed) {
  BodyModel open = *model;
  open.rolls = false;
  batch.model = std::make_shared<const BodyModel>(open);
  const RigidMotion before = motion();
  apply(Stage::rolling_resistance, {{0, 0.01, 0}, 0});
  EXPECT_LT(glm::distance(motion().momentum, before.momentum), 1e-6 * glm::length(before.momentum));
}

TEST_F(ResistanceOfABody, DampsARebound) {
  const glm::dvec3 before = motion().velocity;
  const double impulse = 0.5 * material[Material::mass] * material[contact::rebound_speed];
  apply(Stage::rebound_damping, {{0, impulse, 0}, 0});
  EXPECT_NEAR(motion().velocity.y, 0.5 * before.y, 1e-5);
  EXPECT_NEAR(motion().velocity.x, before.x, 1e-6);
}

/// The damper takes half of the speed at once, and restitution gives the energy of that back in the next frame.
TEST_F(ResistanceOfABody, ReturnsWhatItDampedOfARebound) {
  const glm::dvec3 before = motion().velocity;
  const double impulse = 0.5 * material[Material::mass] * material[contact::rebound_speed];
  impact = {.speed = 10, .parting = float(before.y)};
  apply({Stage::rebound_damping, Stage::restitution}, {{0, impulse, 0}, 1});
  EXPECT_NEAR(motion().velocity.y, before.y / 2, 1e-3);
  apply(Stage::restitution);
  EXPECT_NEAR(motion().velocity.y, before.y, 1e-5);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
