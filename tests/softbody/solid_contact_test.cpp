#include "softbody/contact/solid_contact.h"

#include <gtest/gtest.h>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

/// Two balls of radius 0.5 over a plane at height 0, the second of which does not move. They fall at 3 m/s.
class SolidContactOverAPlane : public testing::Test {
 protected:
  SolidContactOverAPlane() {
    Material material = spring_ball();
    material[Material::thickness] = 0.01;
    model = make_unbalanced_body_model({}, material);
    for (int i = 0; i < 2; ++i) state.add(model, {2 * i, height, 1}, {0.1, -3, 0});
    state.set_pinned(1, true);
    solids.set_parts(false, true);
  }
  const Batch& batch() const { return state.batches()[0]; }
  void begin_frame(double plane_height) {
    solids.begin_frame();
    const Solid plane{SolidPlane{{0, plane_height, 0}}, 0.5, 0.5}, passable{SolidSphere{}, 0.5, 0.5, false};
    solids.add(batch(), state.extent(batch(), state.x, state.v), std::array{plane, passable}, {0, -9.81, 0}, 0.02);
  }

  static constexpr double height = 0.52;
  static constexpr float h = 0.01f;  // s
  std::shared_ptr<const BodyModel> model;
  State state;
  SolidContact solids{state};
};

TEST_F(SolidContactOverAPlane, KnowsNoSolidThatIsFarAway) {
  begin_frame(-3);
  EXPECT_TRUE(solids.near(batch()).empty());
  const std::uint64_t before = state.hash();
  solids.apply(batch(), h);
  EXPECT_EQ(state.hash(), before);
  EXPECT_EQ(solids.pushed(batch()), 0u);
}

TEST_F(SolidContactOverAPlane, KeepsParticlesOutAndSumsTheImpulse) {
  begin_frame(0);
  ASSERT_EQ(solids.near(batch()).size(), 1u);
  const VectorArray before = state.v;
  solids.apply(batch(), h);
  EXPECT_EQ(solids.pushed(batch()), 1u) << "the lane that moves";
  double gained = 0;
  for (Index i = 0; i < batch().particles(); ++i) {
    const std::size_t own = state.slot(0, i), other = state.slot(1, i);
    ASSERT_GE(height + double(state.x[1][own] + h * state.v[1][own]), 0.01 - 1e-6);
    ASSERT_EQ(state.v[1][other], before[1][other]);
    gained += model->particle_mass * double(state.v[1][own] - before[1][own]);
  }
  EXPECT_GT(gained, 0);
  solids.end_frame();
  EXPECT_NEAR(solids.push(0).impulse.y, gained, 1e-5 * gained);
  EXPECT_EQ(solids.push(0).restitution, 0.5);
  EXPECT_EQ(solids.push(1).impulse, glm::dvec3(0.0));
  solids.remove(0);
  EXPECT_EQ(solids.push(0).impulse, glm::dvec3(0.0)) << "the push of the body that was the second";
}

/// By the work of its impulse on the way from the velocities that were noted: what forces press on a particle at rest
/// takes nothing.
TEST_F(SolidContactOverAPlane, SumsTheEnergyThatRestitutionReturns) {
  begin_frame(0);
  const VectorArray noted = state.v;
  solids.note_velocities(batch());
  for (Index i = 0; i < batch().particles(); ++i) state.v[1][state.slot(0, i)] -= 1;  // by a force
  const VectorArray pressed = state.v;
  solids.apply(batch(), h);
  double taken = 0;
  for (Index i = 0; i < batch().particles(); ++i) {
    const std::size_t at = state.slot(0, i);
    const double before = double(noted[1][at]), after = double(state.v[1][at]);
    taken -= model->particle_mass * (after - double(pressed[1][at])) * (before + after) / 2;
  }
  ASSERT_GT(taken, 0);
  solids.end_frame();
  EXPECT_NEAR(solids.push(0).returned, 0.25 * taken, 1e-5 * taken);
}

TEST_F(SolidContactOverAPlane, HasTheLargerRestitutionOfSolidAndMaterial) {
  Material bouncy = model->material;
  bouncy[contact::restitution] = 0.75;
  state.replace(model, make_unbalanced_body_model({}, bouncy));
  begin_frame(0);
  EXPECT_EQ(solids.near(batch())[0].restitution, 0.75f);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
