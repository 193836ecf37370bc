// Implicit steps of a batch: its matrices, what touches it, and the way from its start to its end.

#include "softbody/integrate/implicit/implicit_steps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "softbody/integrate/implicit/step_contacts.h"
#include "tests/softbody/implicit_rig.h"
#include "tests/support/penalty_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

/// A batch of balls that does not stand first in the arrays, on ground that lies at a height of its own for each lane.
struct BatchRig {
  static constexpr std::size_t base = 3 * lanes;
  static constexpr double h = 0.01, nowhere = -100;  // s, and m: ground that nothing comes to
  std::shared_ptr<const BodyModel> model = make_body_model({}, gas_ball(1e5));
  std::array<float, lanes> moves{};
  Batch own;
  LaneField x{particles() + 3}, v = x, mean = x, rest = x;
  glm::dvec3 gravity{0, -9.81, 0};
  PenaltyContact penalty;
  std::vector<SolidArguments> solids{1};
  LaneVector impulse{};
  std::array<float, lanes> returned{}, given{};

  BatchRig() {
    solids[0].moves = moves.data();
    solids[0].shape = PlaneShape<float>{{0, 1, 0}};
    solids[0].near = ~0u;
    std::fill_n(solids[0].place.y, lanes, float(nowhere));
    for (std::size_t lane = 0; lane < implicit_lanes; ++lane) start(lane, glm::dvec3(0.0));
    moves = {};
  }
  std::vector<ContactRow> features;
  std::size_t particles() const { return model->mesh.vertices.size(); }
  /// Starts a ball in a lane, that moves.
  void start(std::size_t lane, const glm::dvec3& velocity) {
    moves[lane] = 1;
    for (std::size_t i = 0; i < particles(); ++i) {
      x.set(3 + i, int(lane), model->start[i]);
      v.set(3 + i, int(lane), velocity);
    }
  }
  /// Puts the ground `gap` m below the ball in a lane.
  void set_ground(std::size_t lane, double gap) {
    double lowest = 0;
    for (std::size_t i = 0; i < particles(); ++i) lowest = std::min(lowest, x.at(3 + i, int(lane)).y);
    solids[0].place.y[lane] = float(lowest - gap);
  }
  ImplicitBatch batch(std::span<const PenaltyEnd> ends = {}) {
    own = {.model = model, .width = lanes, .base = base, .used = implicit_lanes, .moves = moves};
    return {own, x.field(), v.field(), gravity, solids, features, penalty, ends, [](BodyId id) { return id < 2; }};
  }
  ImplicitResult result() { return {mean.field(), rest.field(), {field(impulse), returned.data(), given.data()}}; }
  /// m/s, of a lane's ball as a whole.
  glm::dvec3 velocity(const LaneField& f, int lane) const {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < particles(); ++i) sum += f.at(3 + i, lane) / double(particles());
    return sum;
  }
  /// The start as attempts see it.
  ImplicitBodies bodies() const {
    ImplicitBodies w(*model);
    for (std::size_t i = 0; i < particles(); ++i)
      for (std::size_t lane = 0; lane < implicit_lanes; ++lane) {
        put(w.x, i, lane, x.at(3 + i, int(lane)));
        put(w.v, i, lane, v.at(3 + i, int(lane)));
      }
    return w;
  }
};

TEST(ImplicitMatrices, KeepTheLastOnes) {
  const auto model = make_body_model({}, gas_ball(1e4));
  ImplicitMatrices matrices;
  const auto length = [](std::size_t i) { return 1e-2 / double(i + 1); };
  std::vector<const ImplicitMatrix*> before;
  for (std::size_t i = 0; i < ImplicitMatrices::max_lengths; ++i) {
    matrices.prepare(*model, length(i));
    before.push_back(&matrices.at(length(i)));
  }
  matrices.prepare(*model, length(0));  // so that the second one is the oldest
  matrices.prepare(*model, 1e-4);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (i == 1) continue;
    EXPECT_EQ(&matrices.at(length(i)), before[i]);
  }
}

TEST(FindPlanes, TakesPointsOfFacesAndEdgesOnce) {
  BatchRig rig;
  const auto row = [](std::size_t lane, std::array<std::uint32_t, 3> particles, std::array<float, 3> weights) {
    ContactRow r{};
    for (std::size_t k = 0; k < 3; ++k)
      r.slot[k] = std::uint32_t(particles[k] * lanes + lane), r.weight[k] = weights[k];
    r.normal = {0, 1, 0}, r.target = -2, r.friction = 0.25f;
    return r;
  };
  // Two faces meet the solid in a point of the edge between them, the second as it is rounded there.
  rig.features = {row(2, {4, 5, 6}, {0.25f, 0, 0.75f}), row(2, {6, 4, 7}, {0.7500001f, 0.2499999f, 0}),
                  row(2, {4, 5, 6}, {0.25f, 0.25f, 0.5f}), row(1, {4, 5, 6}, {0.25f, 0, 0.75f}),
                  row(3, {4, 5, 6}, {0.25f, 0, 0.75f})};
  ImplicitBodies bodies = rig.bodies();
  const LaneMask moving = mask({1, 2});
  const MovingAxes axes(bodies.x, bodies.v, moving, rig.h, rig.gravity);
  find_planes(rig.batch(), axes, bodies);
  std::erase_if(bodies.planes, [](const PlaneContact& c) { return c.point.weight[0] == 1; });
  ASSERT_EQ(bodies.planes.size(), 3u) << "one in lane 1, and two in lane 2";
  for (std::size_t i = 0; i < 3; ++i) {
    const PlaneContact& c = bodies.planes[i];
    EXPECT_EQ(c.point.lane(), i == 0 ? 1u : 2u);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(c.point.at[k], (4 + k) * implicit_lanes + c.point.lane());
    EXPECT_EQ(c.point.weight[2], i == 2 ? 0.5 : 0.75);
    EXPECT_EQ(c.friction, 0.25);
    EXPECT_NEAR(c.min_displacement, -2 * rig.h, 1e-12);
  }
}

/// Gaps in front of a particle may close, and overlaps are pushed out as the law of contact has it.
TEST(FindPlanes, AsksForWhatTheLawOfContactAsksFor) {
  BatchRig rig;
  rig.gravity = glm::dvec3(0.0);
  for (const std::size_t lane : {0u, 1u, 2u}) rig.start(lane, {0, -2, 0});  // 2 cm in the step
  rig.set_ground(0, 0.03);
  rig.set_ground(1, 0.01);
  rig.set_ground(2, -0.02);
  rig.set_ground(3, 0.01);
  ImplicitBodies bodies = rig.bodies();
  const LaneMask moving = mask({0, 1, 2});
  const MovingAxes axes(bodies.x, bodies.v, moving, rig.h, rig.gravity);
  EXPECT_EQ(find_planes(rig.batch(), axes, bodies), mask({1, 2}));
  EXPECT_EQ(bodies.planes.size(), 3 * rig.particles()) << "none of lanes that do not move";
  double least_gap[] = {1, 1, 1, 1}, most_out[] = {0, 0, 0, 0};
  for (const PlaneContact& c : bodies.planes) {
    EXPECT_EQ(c.normal, glm::dvec3(0, 1, 0));
    EXPECT_EQ(c.force, glm::dvec3(0.0));
    least_gap[c.point.lane()] = std::min(least_gap[c.point.lane()], -c.min_displacement);
    most_out[c.point.lane()] = std::max(most_out[c.point.lane()], c.out());
  }
  EXPECT_NEAR(least_gap[0], 0.03, 1e-6);
  EXPECT_NEAR(least_gap[1], 0.01, 1e-6);
  EXPECT_NEAR(most_out[2], law::push_share * 0.02, 1e-6);
}

/// Two pairs of particle 5 of the ball in lane 1, whose body is 0: with body 1, and with body 2, which does not move.
struct PairRig : BatchRig {
  PairRig() {
    start(1, {0, -1, 0});
    PenaltyTestAccess::layer(penalty).thickness = 0.1f;
    for (const BodyId other : {BodyId(1), BodyId(2)}) {
      x.set(other, 0, x.at(3 + 5, 1) + glm::dvec3(0.01, -0.05, 0));
      v.set(other, 0, {0.5, 0.25, 0});
      PenaltyPair pair{.contact = {5, 1000 + other},
                       .body_a = 0,
                       .body_b = other,
                       .slot_a = base + 5 * lanes + 1,
                       .slot_b = other * lanes,
                       .offset = glm::vec3(0.0f),
                       .normal = glm::vec3(0, 1, 0),
                       .stiffness = 100,
                       .friction = 0.5f,
                       .damped_mass = 1};
      ends.push_back({std::uint32_t(penalty.pairs().size()), 0});
      PenaltyTestAccess::add(penalty, pair);
    }
    PenaltyTestAccess::group(penalty, x.x.size());
    penalty.gather(x.field(), v.field());
    penalty.evaluate({0, 2}, {float(h)});
  }
  std::vector<PenaltyEnd> ends;
};

TEST(FindPenaltyPairs, LinearisesThemAboutTheFirstVelocities) {
  PairRig rig;
  ImplicitBodies bodies = rig.bodies();
  EXPECT_EQ(find_penalty_pairs(rig.batch(rig.ends), mask({1, 2}), rig.h, bodies), mask({1}));
  ASSERT_EQ(bodies.penalty_pairs.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const LinearPenaltyPair& s = bodies.penalty_pairs[i];
    const glm::dvec3 partner = i == 0 ? rig.h * glm::dvec3(0.5, 0.25, 0) : glm::dvec3(0.0), own = {0, -rig.h, 0};
    EXPECT_EQ(s.at, 5 * implicit_lanes + 1);
    EXPECT_LT(glm::distance(s.partner, partner), 1e-9);
    EXPECT_LT(glm::distance(s.start_separation, own - partner), 1e-9);
    const glm::dvec3 force = rig.penalty.force({std::uint32_t(i), 0});
    ASSERT_GT(force.y, 1) << "N";
    EXPECT_LT(glm::distance(s.force, force), 1e-9);
    // Where the particle goes on as at the start, the damper pulls no more than it does already.
    const double pressed = -glm::dot(s.start_separation, s.normal);
    EXPECT_NEAR(s.force_after(own).y, force.y + double(s.slopes.spring) * pressed, 1e-6);
    EXPECT_GT(s.max_work, 0);
  }
}

TEST(FindPenaltyPairs, LeavesOutBodiesThatDoNotMove) {
  PairRig rig;
  ImplicitBodies bodies = rig.bodies();
  bodies.penalty_pairs.resize(1);
  EXPECT_EQ(find_penalty_pairs(rig.batch(rig.ends), mask({0}), rig.h, bodies), LaneMask());
  EXPECT_TRUE(bodies.penalty_pairs.empty());
}

TEST(ImplicitSteps, TakeABatchToItsEnd) {
  BatchRig rig;
  rig.start(0, {1, 0, 0});
  rig.start(1, {0, -2, 0});
  rig.set_ground(1, 0.001);
  rig.set_ground(3, 0.001);
  rig.solids[0].restitution = 0.25f;
  const LaneField x = rig.x, v = rig.v;
  ImplicitSteps steps;
  steps.prepare(rig.model, rig.h, 1);
  steps.advance(0, rig.batch(), rig.result(), rig.h);
  EXPECT_EQ(rig.x, x);
  EXPECT_EQ(rig.v, v);
  const glm::dvec3 fall = rig.h * rig.gravity;
  EXPECT_LT(glm::distance(rig.velocity(rig.mean, 0), glm::dvec3(1, 0, 0) + fall / 2.0), 1e-6) << "second order";
  EXPECT_LT(glm::distance(rig.velocity(rig.rest, 0), fall / 2.0), 1e-6);
  const double mass = rig.model->material[Material::mass];
  const glm::dvec3 gained = rig.velocity(rig.mean, 1) + rig.velocity(rig.rest, 1) - glm::dvec3(0, -2, 0) - fall;
  EXPECT_GT(gained.y, 0.1) << "m/s";
  EXPECT_NEAR(mass * gained.y, double(rig.impulse.y[1]), 0.1 * mass * gained.y);
  EXPECT_GT(rig.returned[1], 0.0f);
  EXPECT_LT(rig.returned[1], 0.0625f * rig.impulse.y[1] * 2) << "J, of what comes at 2 m/s";
  for (int lane = 2; lane < implicit_lanes; ++lane) {
    EXPECT_EQ(rig.impulse.y[lane], 0);
    EXPECT_EQ(rig.velocity(rig.mean, lane), glm::dvec3(0.0)) << "does not move";
  }
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(rig.mean.at(i, 0), glm::dvec3(0.0)) << "is of another batch";
  EXPECT_GT(steps.take_work(), double(rig.particles()));
  EXPECT_EQ(steps.take_work(), 0);
}

TEST(ImplicitSteps, ForgetModelsThatAreNotInUse) {
  BatchRig rig;
  rig.start(1, {0, -1, 0});
  ImplicitSteps steps;
  const auto advance = [&] {
    steps.prepare(rig.model, rig.h, 1);
    steps.advance(0, rig.batch(), rig.result(), rig.h);
    return rig.mean;
  };
  const LaneField before = advance();
  steps.retain([](const BodyModel&) { return false; });
  EXPECT_EQ(rig.model.use_count(), 2) << "only the rig and its batch have it";
  EXPECT_EQ(advance(), before) << "found anew";
}

}  // namespace THIS_FILE
}  // namespace softbody::test
