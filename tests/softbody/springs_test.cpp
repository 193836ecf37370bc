// The spring kernel of every instruction set against closed forms, each lane on its own.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "softbody/contact/kernels.h"
#include "softbody/forces/kernels/kernels.h"
#include "softbody/state/kernels.h"
#include "tests/every_target.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace {

/// Hooke and damper along the spring, as the paper has them: the force on i.
glm::dvec3 pull(const LaneField& x, const LaneField& v, const SpringOf<float>& s, int lane) {
  const glm::dvec3 dx = x.at(s.j, lane) - x.at(s.i, lane);
  const glm::dvec3 dv = v.at(s.j, lane) - v.at(s.i, lane);
  const double length = glm::length(dx);
  return (double(s.stiffness) * (length - s.rest) + double(s.damping) * glm::dot(dv, dx) / length) * dx / length;
}

std::vector<SpringOf<float>> random_springs(std::mt19937& random, std::uint32_t particles, int count) {
  std::vector<SpringOf<float>> springs;
  while (int(springs.size()) < count) {
    const auto i = std::uint32_t(random() % particles), j = std::uint32_t(random() % particles);
    if (i != j)
      springs.push_back(
          {i, j, float(uniform(random, 0.1, 2)), float(uniform(random, 1, 300)), float(uniform(random, 0, 5))});
  }
  return springs;
}

/// Particles that springs join.
BodyModel model_of(std::size_t particles, const std::vector<SpringOf<float>>& springs) {
  BodyModel model;
  model.mesh.vertices.resize(particles);
  return with_force<StructuralSprings>(std::move(model), {{}, springs});
}

/// Adds the springs' forces.
void add(const std::vector<SpringOf<float>>& springs, const LaneField& x, const LaneField& v, LaneField& f) {
  force_kernels(lanes).add[index_of<StructuralSprings>](
      {model_of(x.x.size() / lanes, springs), lanes, x.field(), f.field()}, {v.field()});
}

class SpringForces : public tests::OnEveryTarget {};

TEST_P(SpringForces, OneSpringHasTheClosedFormInEachLane) {
  std::mt19937 random(1);
  LaneField x(2), v(2), f(2);
  x.randomise(random, 1);
  v.randomise(random, 3);
  const std::vector<SpringOf<float>> spring{{0, 1, 0.8f, 120.0f, 2.5f}};
  add(spring, x, v, f);
  for (int l = 0; l < lanes; ++l) {
    const glm::dvec3 expected = pull(x, v, spring[0], l);
    EXPECT_NEAR(glm::distance(f.at(0, l), expected), 0, 2e-6 * (glm::length(expected) + 100)) << "lane " << l;
    EXPECT_EQ(f.at(0, l), -f.at(1, l));
  }
}

TEST_P(SpringForces, AStretchedSpringPullsAndASqueezedOnePushes) {
  LaneField x(2), v(2), f(2);
  for (int l = 0; l < lanes; ++l) x.set(1, l, {0.25 * (l + 1), 0, 0});
  const std::vector<SpringOf<float>> spring{{0, 1, 1.0f, 8.0f, 0.0f}};
  add(spring, x, v, f);
  for (int l = 0; l < lanes; ++l)
    EXPECT_NEAR(glm::distance(f.at(0, l), glm::dvec3(8 * (0.25 * (l + 1) - 1), 0, 0)), 0, 1e-5) << "lane " << l;
}

TEST_P(SpringForces, TheDamperActsOnTheRelativeSpeedAlongTheSpringOnly) {
  LaneField x(2), v(2), f(2);
  for (int l = 0; l < lanes; ++l) {
    x.set(1, l, {0, 0, 2});
    v.set(0, l, {5, 5, 1.0 * l});
    v.set(1, l, {-7, 9, 4});
  }
  const std::vector<SpringOf<float>> damper{{0, 1, 2.0f, 50.0f, 3.0f}};  // at its rest length
  add(damper, x, v, f);
  for (int l = 0; l < lanes; ++l)
    EXPECT_NEAR(glm::distance(f.at(0, l), glm::dvec3(0, 0, 3.0 * (4 - l))), 0, 1e-5) << "c (dv . dx) / |dx|";
}

TEST_P(SpringForces, OfLengthZeroPullsNowhere) {
  LaneField x(2), v(2), f(2);
  for (int l = 0; l < lanes; ++l) {
    x.set(0, l, {1, 2, 3});
    x.set(1, l, {1, 2, 3});
    v.set(0, l, {1.0 * l, 0, 0});
  }
  x.set(1, 5, {1, 2, 4});  // its neighbours do not disturb a lane
  const std::vector<SpringOf<float>> spring{{0, 1, 0.5f, 100.0f, 1.0f}};
  add(spring, x, v, f);
  for (int l = 0; l < lanes; ++l)
    EXPECT_EQ(f.at(0, l), l == 5 ? glm::dvec3(0, 0, 50) : glm::dvec3(0.0)) << "lane " << l;
}

TEST_P(SpringForces, ForcesAreAddedAndTheirSumsAndTorquesVanish) {
  std::mt19937 random(2);
  constexpr std::uint32_t n = 40;
  LaneField x(n), v(n), f(n);
  x.randomise(random, 1);
  v.randomise(random, 2);
  const auto springs = random_springs(random, n, 300);
  add(springs, x, v, f);
  for (int l = 0; l < lanes; ++l) {
    std::vector<glm::dvec3> expected(n, glm::dvec3(0.0));
    for (const auto& s : springs) {
      expected[s.i] += pull(x, v, s, l);
      expected[s.j] -= pull(x, v, s, l);
    }
    glm::dvec3 sum(0.0), torque(0.0);
    double size = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      EXPECT_NEAR(glm::distance(f.at(i, l), expected[i]), 0, 1e-2) << "of some " << glm::length(expected[i]) << " N";
      sum += f.at(i, l);
      torque += glm::cross(x.at(i, l), f.at(i, l));
      size += glm::length(f.at(i, l));
    }
    EXPECT_LT(glm::length(sum), 1e-6 * size);
    EXPECT_LT(glm::length(torque), 1e-6 * size);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SpringForces, testing::ValuesIn(tests::targets()), tests::target_name);

/// Everything that the kernels of one instruction set make of the same random state.
struct Trace {
  LaneField x, v, f;
  LaneArray<float> volume;
  LaneVector impulse{};
  Extent extent{};
  std::array<unsigned, 4> acted{};  // by shape
  bool operator==(const Trace& o) const {
    return x == o.x && v == o.v && f == o.f && volume == o.volume && acted == o.acted &&
           !std::memcmp(&impulse, &o.impulse, sizeof impulse) && !std::memcmp(&extent, &o.extent, sizeof extent);
  }
};

Trace trace(std::int64_t target) {
  const tests::UseTarget use(target);
  const StateKernels& state = state_kernels(lanes);
  std::mt19937 random(3);
  const Mesh mesh = icosphere(1, 0.5);
  const std::size_t n = mesh.vertices.size();
  Trace t{LaneField(n), LaneField(n), LaneField(n), LaneArray<float>(lanes)};
  t.x.randomise(random, 0.02);
  t.v.randomise(random, 2);
  for (std::size_t i = 0; i < n; ++i)
    for (int l = 0; l < lanes; ++l) t.x.set(i, l, t.x.at(i, l) + mesh.vertices[i]);
  const auto springs = random_springs(random, std::uint32_t(n), 120);
  BodyModel holds_gas;
  holds_gas.mesh = mesh;
  holds_gas = with_force<GasPressure>(holds_gas, {.amount = 20, .ambient = 30, .rest_volume = 0.5});
  float moves[lanes], returned[lanes]{}, work[lanes]{};
  for (int l = 0; l < lanes; ++l) moves[l] = l % 5 == 2 ? 0.0f : 1.0f;
  const SolidShape<float> shapes[]{
      SphereShape<float>{0.4f}, PlaneShape<float>{{0, 1, 0}},
      BoxShape<float>{{{0.6f, 0.8f, 0}, {-0.8f, 0.6f, 0}, {0, 0, 1}}, {0.5f, 0.2f, 1}, 0.01f},
      CapsuleShape<float>{{1, 0, 0.25f}, 0.2f}};
  SolidArguments solid{n,        0.02f, 0.5f, 0.25f, {}, {}, moves, {t.impulse.x, t.impulse.y, t.impulse.z},
                       returned, work,  0.01f};
  for (int l = 0; l < lanes; ++l) solid.place.y[l] = -0.45f + 0.01f * float(l);
  const auto constant = [](const LaneField& f) { return f.field(); };
  for (int step = 0; step < 5; ++step) {
    add(springs, t.x, t.v, t.f);
    const LaneBodies<float> bodies{holds_gas, lanes, constant(t.x), t.f.field()};
    SurfaceShape surfaces[lanes];
    force_kernels(lanes).measure_surfaces(bodies, surfaces);
    for (int l = 0; l < lanes; ++l) t.volume[std::size_t(l)] = float(surfaces[l].volume);
    force_kernels(lanes).add[index_of<GasPressure>](bodies, {constant(t.v)});
    state.kick(lanes, {n, 0.01f, 0.0f, -0.098f, 0.01f, moves}, constant(t.f), t.v.field());
    const LaneField before = t.v;
    solid.before = before.field();
    for (std::size_t shape = 0; shape < std::size(shapes); ++shape) {
      solid.shape = shapes[shape];
      t.acted[shape] |= act_by_solid(lanes, lanes, solid, constant(t.x), t.v.field());
    }
    state.drift(lanes, n, 0.01f, moves, constant(t.v), t.x.field());
    state.extent(lanes, n, constant(t.x), constant(t.v), t.extent);
  }
  return t;
}

TEST(Kernels, GiveTheSameBitsOnEveryInstructionSet) {
  const Trace baseline = trace(tests::targets().back());
  for (const unsigned acted : baseline.acted) EXPECT_NE(acted, 0u) << "or a solid took no part";
  for (const std::int64_t target : tests::targets()) EXPECT_TRUE(trace(target) == baseline);
}

TEST(Kernels, KickAndDriftLeaveBodiesThatDoNotMoveAlone) {
  for (const std::int64_t target : tests::targets()) {
    const tests::UseTarget use(target);
    std::mt19937 random(4);
    LaneField x(3), v(3), f(3);
    x.randomise(random, 1);
    v.randomise(random, 1);
    f.randomise(random, 1);
    const LaneField x0 = x, v0 = v;
    float moves[lanes];
    for (int l = 0; l < lanes; ++l) moves[l] = l % 3 == 1 ? 0.0f : 1.0f;
    state_kernels(lanes).kick(lanes, {3, 0.5f, 0.25f, -1, 2, moves}, std::as_const(f).field(), v.field());
    state_kernels(lanes).drift(lanes, 3, 0.125f, moves, std::as_const(v).field(), x.field());
    for (std::size_t i = 0; i < 3; ++i)
      for (int l = 0; l < lanes; ++l) {
        const glm::dvec3 dv = double(moves[l]) * (0.5 * f.at(i, l) + glm::dvec3(0.25, -1, 2));
        EXPECT_NEAR(glm::distance(v.at(i, l), v0.at(i, l) + dv), 0, 1e-6);
        EXPECT_NEAR(glm::distance(x.at(i, l), x0.at(i, l) + 0.125 * double(moves[l]) * v.at(i, l)), 0, 1e-6);
      }
  }
}

TEST(Kernels, ExtentIsTheBoxAndTheFastestOfEachLane) {
  for (const std::int64_t target : tests::targets()) {
    const tests::UseTarget use(target);
    std::mt19937 random(5);
    LaneField x(20), v(20);
    x.randomise(random, 4);
    v.randomise(random, 4);
    Extent e;
    state_kernels(lanes).extent(lanes, 20, std::as_const(x).field(), std::as_const(v).field(), e);
    for (int l = 0; l < lanes; ++l) {
      glm::dvec3 lo = x.at(0, l), hi = lo;
      double speed2 = 0;
      for (std::size_t i = 0; i < 20; ++i) {
        lo = glm::min(lo, x.at(i, l)), hi = glm::max(hi, x.at(i, l));
        speed2 = std::max(speed2, glm::dot(v.at(i, l), v.at(i, l)));
      }
      EXPECT_EQ(glm::dvec3(e.lo.x[l], e.lo.y[l], e.lo.z[l]), lo);
      EXPECT_EQ(glm::dvec3(e.hi.x[l], e.hi.y[l], e.hi.z[l]), hi);
      EXPECT_NEAR(e.length2[l], speed2, 1e-5 * speed2);
    }
  }
}

}  // namespace
}  // namespace softbody::test
