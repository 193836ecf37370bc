#include "softbody/state/state.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

/// Two balls more of one model than a batch has lanes, and one of another; each has a velocity of its own.
class StateOfTwoModels : public testing::Test {
 protected:
  StateOfTwoModels() {
    for (int i = 0; i < lanes + 2; ++i) state.add(ball, {i, 0, 0}, {0, i, 0});
    state.add(other, {100, 0, 0}, {0, 100, 0});
  }
  std::vector<double> speeds() const {
    std::vector<double> list;
    for (BodyId id = 0; id < state.body_count(); ++id) list.push_back(state.particle(id, 3).velocity.y);
    return list;
  }

  std::shared_ptr<const BodyModel> ball = make_unbalanced_body_model({}, spring_ball());
  std::shared_ptr<const BodyModel> other = make_unbalanced_body_model({}, spring_ball());
  State state;
};

TEST_F(StateOfTwoModels, FillsTheLanesOfABatchOfOneModel) {
  ASSERT_EQ(state.batches().size(), 3u);
  EXPECT_EQ(state.batches()[0].used, lanes);
  EXPECT_EQ(state.batches()[1].used, 2);
  EXPECT_EQ(state.batches()[2].model, other);
  for (BodyId id = 0; id < state.body_count(); ++id) {
    const Batch& b = state.batch_of(id);
    EXPECT_EQ(b.body[std::size_t(state.body(id).lane)], id);
    EXPECT_EQ(&state.batches()[b.index], &b);
    EXPECT_EQ(state.particle(id, 7).position, state.body(id).origin + glm::dvec3(glm::vec3(state.model(id).start[7])));
  }
}

TEST_F(StateOfTwoModels, KeepsTheOthersWhenOneIsRemoved) {
  std::vector<double> expected = speeds();
  expected.erase(expected.begin() + 2);
  const std::uint32_t number = state.body(3).number;
  state.remove(2);
  EXPECT_EQ(speeds(), expected);
  EXPECT_EQ(state.body(2).number, number) << "a body keeps its number when its id moves up";
  EXPECT_EQ(state.batches()[0].used, lanes - 1);
  EXPECT_EQ(state.batches()[0].moves[std::size_t(lanes - 1)], 0) << "the lane that is left";
  const BodyId id = state.add(ball, {50, 0, 0}, {0, 50, 0});
  EXPECT_EQ(state.batch_of(id).index, 0u) << "the free lane is taken again";
  expected.push_back(50);
  EXPECT_EQ(speeds(), expected);
}

TEST_F(StateOfTwoModels, StopsBodiesThatFallAsleep) {
  state.set_asleep(4, true);
  EXPECT_EQ(state.max_particle_speed(4), 0);
  EXPECT_EQ(state.batch_of(4).moves[std::size_t(state.body(4).lane)], 0);
  EXPECT_EQ(state.max_particle_speed(5), 5);
  state.set_asleep(4, false);
  state.set_pinned(5, true);
  EXPECT_TRUE(state.body(4).moves());
  EXPECT_FALSE(state.body(5).moves());
  EXPECT_EQ(state.max_particle_speed(5), 5) << "a pinned body keeps its velocity until it is released";
}

TEST_F(StateOfTwoModels, CallsABodyThatIsNotFiniteInfinitelyFast) {
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f}) {
    State broken = state;
    broken.v[2][broken.slot(3, 5)] = value;
    EXPECT_EQ(broken.max_particle_speed(3), std::numeric_limits<double>::infinity()) << value;
    EXPECT_EQ(broken.max_particle_speed(4), 4);
  }
}

TEST_F(StateOfTwoModels, RecentresWithoutLoss) {
  std::vector<Particle> particles;
  for (Index i = 0; i < ball->mesh.vertices.size(); ++i) particles.push_back(state.particle(1, i));
  const std::uint64_t before = state.hash();
  state.recentre(state.batch_of(1));
  EXPECT_EQ(state.hash(), before) << "all are near their origins";
  for (Particle& p : particles) p.position.x += 1000.25;
  state.set_particles(1, particles);
  for (auto& x : state.x[0]) x += 4;  // all bodies go on by 4 m
  state.set_pinned(2, true);
  state.recentre(state.batch_of(1));
  EXPECT_EQ(state.body(2).origin, glm::dvec3(2, 0, 0)) << "it does not move by itself";
  EXPECT_LT(std::abs(state.x[0][state.slot(1, 0)]), 1.5 * ball->radius);
  for (Index i = 0; i < particles.size(); ++i)
    ASSERT_NEAR(state.particle(1, i).position.x, particles[i].position.x + 4, 1e-6);
}

TEST_F(StateOfTwoModels, IsRestoredToTheBit) {
  const std::uint64_t hash = state.hash();
  const State saved = state.saved();
  EXPECT_TRUE(saved.f[0].empty());
  state.remove(0);
  state.v[1][state.slot(3, 5)] += 1;
  EXPECT_NE(state.hash(), hash);
  state.restore(saved);
  EXPECT_EQ(state.hash(), hash);
  EXPECT_EQ(state.f[0].size(), state.x[0].size());
  state.add(ball, glm::dvec3(0.0), glm::dvec3(0.0));
  EXPECT_EQ(state.body(state.body_count() - 1).number, lanes + 3u);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
