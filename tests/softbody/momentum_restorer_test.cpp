#include "softbody/integrate/momentum_restorer.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "softbody/state/rigid_motion.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

/// Three lanes hold a body: the first two move.
class MomentumRestorerOfABatch : public testing::Test {
 protected:
  MomentumRestorerOfABatch() {
    batch.model = make_unbalanced_body_model({}, spring_ball());
    batch.used = 3;
    batch.moves = {1, 1};
    x = v = LaneField(batch.particles());
    for (std::size_t i = 0; i < batch.particles(); ++i)
      for (int l = 0; l < batch.used; ++l) x.set(i, l, batch.model->start[i]);
    v.randomise(random, 1);
  }
  BatchView view() { return {batch, x.field(), v.field()}; }
  RigidMotion motion(int lane) {
    const auto of_lane = [lane](LaneField& field) { return BodyField{field.field(), std::size_t(lane), lanes}; };
    return rigid_motion(batch.particles(), of_lane(x), of_lane(v));
  }
  void disturb() {
    LaneField change = v;
    change.randomise(random, 0.1);
    for (std::size_t i = 0; i < batch.particles(); ++i)
      for (int l = 0; l < batch.used; ++l) v.set(i, l, v.at(i, l) + change.at(i, l));
  }

  std::mt19937 random{5};
  Batch batch;
  LaneField x{0}, v{0};
};

TEST_F(MomentumRestorerOfABatch, RestoresBothMomenta) {
  MomentumRestorer restorer;
  restorer.note(view());
  const RigidMotion before = motion(0);
  disturb();
  const double lost = glm::distance(motion(0).momentum, before.momentum);
  const glm::dvec3 fall(0, -3, 0);
  restorer.restore(fall, true, std::array{0u});
  EXPECT_LT(glm::distance(motion(0).velocity, before.velocity + fall), 1e-6);
  EXPECT_LT(glm::distance(motion(0).momentum, before.momentum), 0.01 * lost);
}

TEST_F(MomentumRestorerOfABatch, LeavesTheSpinToAnIntegratorThatChangesIt) {
  MomentumRestorer restorer;
  restorer.note(view());
  const glm::dvec3 velocity = motion(0).velocity;
  disturb();
  const RigidMotion disturbed = motion(0);
  restorer.restore(glm::dvec3(0.0), false, std::array{0u});
  EXPECT_LT(glm::distance(motion(0).velocity, velocity), 1e-6);
  EXPECT_LT(glm::distance(motion(0).momentum, disturbed.momentum), 1e-5 * glm::length(disturbed.momentum));
}

TEST_F(MomentumRestorerOfABatch, LeavesAloneWhatIsPushedOrDoesNotMove) {
  MomentumRestorer restorer;
  restorer.note(view());
  disturb();
  const LaneField disturbed = v;
  restorer.restore(glm::dvec3(1, 2, 3), true, std::array{1u << 1});
  EXPECT_NE(v.at(0, 0), disturbed.at(0, 0));
  for (std::size_t i = 0; i < batch.particles(); ++i)
    for (const int lane : {1, 2}) ASSERT_EQ(v.at(i, lane), disturbed.at(i, lane));
}

}  // namespace THIS_FILE
}  // namespace softbody::test
