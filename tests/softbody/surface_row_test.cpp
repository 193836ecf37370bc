// Contact of the true surfaces, one row of it: one vertex against the middle of a face, by closed forms.

#include "softbody/contact/surface_contact.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "softbody/contact/law.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

struct Impact {
  float gap = 0.01f;  // m, beyond the distance that is kept
  glm::vec3 velocity{0, -10, 0};
  float restitution = 0, friction = 0, restitution_b = 0;
  float inverse_a = 2, inverse_b = 0.5f;  // 1/kg, of a particle
};

/// Triangle a stands on its first vertex above the middle of triangle b, which lies level. b has no velocity.
class OneRow {
 public:
  static constexpr float h = 0.001f, reach = 0.002f;
  explicit OneRow(const Impact& impact) : impact_(impact) {
    const double y = double(impact.gap + 2 * reach);
    place(0, {{0, y, 0}, {0.3, y + 1, 0.1}, {-0.2, y + 1, 0.2}}, impact.velocity);
    place(1, {{-1, 0, -1}, {1, 0, -1}, {0, 0, 2}}, glm::vec3(0));
    before_ = v;
    find();
    contact_.make_rows(0, 1, std::as_const(x).field(), std::as_const(v).field(), 0, h);
    EXPECT_LE(contact_.rows(), 1u);
    solve(h);
  }
  /// Of the vertex towards the point of the face below it.
  glm::dvec3 relative() const { return v.at(0, 0) - (v.at(0, 1) + v.at(1, 1) + v.at(2, 1)) / 3.0; }
  double mass(int body) const { return 1 / double(body == 0 ? impact_.inverse_a : impact_.inverse_b); }
  /// What the contact gave to both bodies together: momentum, and angular momentum about the origin.
  std::pair<glm::dvec3, glm::dvec3> given() const {
    glm::dvec3 linear(0.0), angular(0.0);
    for (int body = 0; body < 2; ++body)
      for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 p = mass(body) * (v.at(i, body) - before_.at(i, body));
        linear += p;
        angular += glm::cross(x.at(i, body), p);
      }
    return {linear, angular};
  }
  /// The row with the impulses that it starts another substep of `seconds` from.
  ContactRow prepare(float seconds) {
    contact_.make_rows(0, 1, std::as_const(x).field(), std::as_const(v).field(), 0, seconds);
    EXPECT_EQ(contact_.rows(), 1u);
    return contact_.save().rows.at(0);
  }
  void solve(float seconds) {
    contact_.solve(0, 1, std::as_const(x).field(), v.field(), seconds, [] {});
  }
  ContactRow row() const { return contact_.save().rows.at(0); }
  LaneField x{3}, v{3};

 private:
  void place(int body, const std::vector<glm::dvec3>& corners, const glm::vec3& velocity) {
    for (std::size_t i = 0; i < 3; ++i) {
      x.set(i, body, corners[i]);
      v.set(i, body, glm::dvec3(velocity));
      seen_[0].push_back(float(corners[i].x)), seen_[1].push_back(float(corners[i].y));
      seen_[2].push_back(float(corners[i].z));
      for (int k = 0; k < 3; ++k) speed_[std::size_t(k)].push_back(velocity[k]);
    }
    const std::vector<collide::surface::Edge> none;
    bodies_.add(std::make_shared<const collide::Shape>(3, none));
  }
  void find() {
    const collide::surface::SurfaceBody traits{&triangle_, reach, 0, 1, true};
    const auto body = [&](std::size_t lane, float inverse_mass, float restitution) {
      const float friction = impact_.friction * (lane == 0 ? 0.5f : 2.0f);  // their geometric mean acts
      return ContactBody{glm::dvec3(0.0), lane, lanes, inverse_mass, friction, restitution};
    };
    collide::Workers workers(1);
    contact_.set_threads(1);
    contact_.candidates().find(
        {{seen_[0], seen_[1], seen_[2], &bodies_}, speed_[0], speed_[1], speed_[2]}, {traits, traits},
        {body(0, impact_.inverse_a, impact_.restitution), body(1, impact_.inverse_b, impact_.restitution_b)},
        {.seconds = h, .min_seconds = h}, h, workers);
  }

  const collide::surface::Surface triangle_{3, {{0, 1, 2}}};
  SurfaceContact contact_;
  Impact impact_;
  LaneField before_{3};
  collide::Bodies bodies_;
  std::array<std::vector<float>, 3> seen_, speed_;
};

TEST(SurfaceContactRow, LetsTheGapAndHalfTheDistanceBeUsedUpAndNoMore) {
  constexpr double rounding = 1e-3;        // m/s: the normal is that of two points some mm apart, in floats of 1 m
  for (const float speed : {0.4f, 10.0f})  // too slow for that, and fast enough
    for (const float gap : {0.0001f, 0.0003f})
      for (const float inverse_b : {0.0f, 0.5f}) {
        const OneRow row({.gap = gap, .velocity = {0, -speed, 0}, .inverse_b = inverse_b});
        EXPECT_NEAR(row.relative().y, -std::min(double(speed), double((gap + OneRow::reach) / OneRow::h)), rounding)
            << speed;
        EXPECT_NEAR(row.relative().x, 0, rounding) << speed;
      }
  for (const float restitution : {0.0f, 0.5f}) {
    const OneRow early({.gap = 0.004f, .velocity = {1, -3, 0}, .restitution = restitution});
    EXPECT_EQ(early.relative(), glm::dvec3(1, -3, 0)) << "not there yet";
  }
  const OneRow leaving({.gap = 0, .velocity = {0, 2, 0}});
  EXPECT_EQ(leaving.relative(), glm::dvec3(0, 2, 0)) << "never pulled";
}

/// J: e^2 of the kinetic energy that the normal impulse takes.
TEST(SurfaceContactRow, CountsWhatRestitutionReturns) {
  for (const float e : {0.25f, 0.5f, 1.0f})
    for (const bool of_b : {false, true}) {  // the body that throws back more
      const OneRow row(
          {.gap = 0.0001f, .velocity = {0, -4, 0}, .restitution = of_b ? 0 : e, .restitution_b = of_b ? e : 0});
      const double after = row.relative().y, mass = double(row.row().mass);
      EXPECT_NEAR(row.row().returned, e * e * mass / 2 * (16 - after * after), 1e-4);
    }
}

TEST(SurfaceContactRow, TakesFrictionTimesTheImpulseFromTheSlip) {
  for (const float mu : {0.0f, 0.2f, 0.5f, 2.0f}) {
    const float gap = 0.0001f;
    const OneRow row({.gap = gap, .velocity = {3, -5, 4}, .friction = mu});
    const double left = double((gap + OneRow::reach) / OneRow::h);       // m/s, along the normal
    const double kept = std::max(0.0, 1 - double(mu) * (5 - left) / 5);  // of the slip, 5 m/s
    EXPECT_NEAR(row.relative().x, 3 * kept, 1e-3) << mu;
    EXPECT_NEAR(row.relative().z, 4 * kept, 1e-3) << mu;
    EXPECT_NEAR(row.relative().y, -left, 1e-3) << mu;
  }
}

/// A damped spring in one implicit step, as a soft constraint (Catto 2011).
TEST(SurfaceContactRow, KeepsTheDistanceByASpring) {
  const double turn = double(SurfaceRowMaker::spring_frequency * OneRow::h);
  const double damping = 2 * double(SurfaceRowMaker::spring_damping) + turn, hardness = turn * damping;
  for (const float depth : {0.0005f, 0.001f, 0.002f})  // still on their own sides, but closer than that
    for (const float speed : {0.0f, 0.2f}) {
      const double widening = double(depth / OneRow::h) * turn / damping;
      EXPECT_NEAR(OneRow({.gap = -depth, .velocity = {0, -speed, 0}}).relative().y,
                  (hardness * widening - double(speed)) / (1 + hardness), 1e-3);
    }
}

TEST(SurfaceContactRow, PushesOverlapsOutAtATenthASubstep) {
  const float depth = 0.0039f, beyond = depth - OneRow::reach;  // of half the distance
  const double spring = OneRow({.gap = -depth, .velocity = {0, 0, 0}}).relative().y;
  EXPECT_GE(spring, 0.1 * double(beyond / OneRow::h) - 1e-3);
  EXPECT_LT(spring, law::max_separation_speed);
}

/// Of a substep half as long, after which the face leans.
TEST(SurfaceContactRow, StartsFromTheLastImpulses) {
  for (const bool overlaps : {false, true}) {
    OneRow row({.gap = overlaps ? -0.003f : 0.0001f, .velocity = {3, -5, 4}, .friction = 0.5f});
    const ContactRow last = row.row();
    ASSERT_GT(glm::length(last.friction_impulse), 0);
    for (std::size_t i = 0; i < 3; ++i) row.x.set(i, 1, row.x.at(i, 1) + glm::dvec3(0, 0.2 * row.x.at(i, 1).x, 0));
    const ContactRow next = row.prepare(OneRow::h / 2);
    ASSERT_LT(next.normal.x, -0.1f);
    const float share = 0.5f * (overlaps ? 0.8f : 1.0f);  // what pushes out is handed on in part
    EXPECT_NEAR(next.normal_impulse, share * last.normal_impulse, 1e-6);
    const glm::vec3 across = last.friction_impulse - glm::dot(last.friction_impulse, next.normal) * next.normal;
    EXPECT_LT(glm::length(next.friction_impulse - share * across), 1e-6);
  }
}

TEST(SurfaceContactRow, GivesNoMomentumInAll) {
  const OneRow smooth({.gap = 0, .velocity = {3, -5, 4}}), rough({.gap = 0, .velocity = {3, -5, 4}, .friction = 0.5f});
  for (const OneRow* row : {&smooth, &rough}) EXPECT_LT(glm::length(row->given().first), 1e-5);
  EXPECT_LT(glm::length(smooth.given().second), 1e-5);
  // Friction acts at two points that are the kept distance apart: a couple of at most that times the friction impulse.
  const double effective = 1 / (1 / rough.mass(0) + 1 / rough.mass(1) / 3);
  EXPECT_LT(glm::length(rough.given().second), 2 * double(OneRow::reach) * 0.5 * 5 * effective * 1.001);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
