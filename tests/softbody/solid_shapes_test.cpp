// The distance functions of the solids against closed forms of what lies in them and how far they reach.

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "softbody/contact/solid_shapes.h"
#include "softbody/contact/solid_surface.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

const SolidSphere sphere{.centre = {0.25, -0.5, 1}, .radius = 0.75};
const SolidBox box{
    .centre = {0.5, 0.25, -0.5},
    .half_size = {0.7, 0.2, 0.4},
    .axes = glm::dmat3(glm::dvec3(0.6, 0.8, 0), glm::dvec3(-0.64, 0.48, 0.6), glm::dvec3(0.48, -0.36, 0.8))};
const SolidCapsule capsule{.from = {-0.5, 0, 0.25}, .to = {0.5, 0.75, -0.25}, .radius = 0.3};
const SolidCapsule ball{.from = {0.25, -0.5, 1}, .to = {0.25, -0.5, 1}, .radius = 0.75};

// How deep (m) a point lies inside, negative outside, and how far (m) a solid reaches along a unit vector.
double depth_in(const SolidSphere& s, const glm::dvec3& p) { return s.radius - glm::distance(p, s.centre); }
double reach(const SolidSphere& s, const glm::dvec3& n) { return glm::dot(s.centre, n) + s.radius; }
double depth_in(const SolidBox& b, const glm::dvec3& p) {
  const glm::dvec3 left = b.half_size - glm::abs(glm::transpose(b.axes) * (p - b.centre));
  return std::min({left.x, left.y, left.z});
}
double reach(const SolidBox& b, const glm::dvec3& n) {
  return glm::dot(b.centre, n) + glm::dot(b.half_size, glm::abs(glm::transpose(b.axes) * n));
}
double depth_in(const SolidCapsule& c, const glm::dvec3& p) {
  const glm::dvec3 along = c.to - c.from;
  const double square = glm::dot(along, along), at = square > 0 ? glm::dot(p - c.from, along) / square : 0;
  return c.radius - glm::distance(p, c.from + std::clamp(at, 0.0, 1.0) * along);
}
double reach(const SolidCapsule& c, const glm::dvec3& n) {
  return std::max(glm::dot(c.from, n), glm::dot(c.to, n)) + c.radius;
}

/// The foot of a point belongs to the solid, and all of the solid lies behind the plane there: no other is nearer.
template <class Shape>
void expect_distances_to(const Shape& shape) {
  constexpr double rounding = 1e-12;
  std::mt19937 random(21);
  int outside = 0;
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 p = random_vector(random, i % 2 ? 2 : 0.7);
    const SolidSurface s = surface_at({shape}, p);
    const glm::dvec3 foot = p - s.distance * s.normal;
    EXPECT_NEAR(glm::length(s.normal), 1, rounding);
    EXPECT_NEAR(depth_in(shape, foot), 0, rounding);
    EXPECT_NEAR(glm::dot(foot, s.normal), reach(shape, s.normal), rounding);
    outside += s.distance > 0;
    if (s.distance < 0) {
      EXPECT_NEAR(-s.distance, depth_in(shape, p), rounding) << "inside, the nearest face counts";
    }
  }
  EXPECT_GT(outside, 500);
  EXPECT_LT(outside, 990);
}

TEST(SolidShapes, AreAsFarAwayAsTheirNearestPoint) {
  expect_distances_to(sphere);
  expect_distances_to(box);
  expect_distances_to(capsule);
  expect_distances_to(ball);
}

TEST(SolidShapes, MeasureAPlaneFromAnywhere) {
  const SolidPlane plane{.point = {1e3, 2e3, 0}, .normal = {0.6, 0.8, 0}};
  EXPECT_NEAR(surface_at({plane}, {1e3 + 3, 2e3 + 4, 500}).distance, 5, 1e-9);
  EXPECT_NEAR(surface_at({plane}, {1e3 + 0.8 * 70, 2e3 - 0.6 * 70, -9}).distance, 0, 1e-9);
  EXPECT_NEAR(surface_at({plane}, {1e3, 2e3 - 2, 0}).distance, -1.6, 1e-9);
  EXPECT_EQ(surface_at({plane}, {0, 0, 0}).normal, plane.normal);
}

/// Edges and corners of a box are as far away as its faces: a rounded box.
TEST(SolidShapes, KeepTheirThicknessAllRound) {
  const glm::dvec3 corner = box.centre + box.axes * box.half_size;
  for (const glm::dvec3& away : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0.6, 0.8), glm::dvec3(0.48, 0.6, 0.64)}) {
    const glm::dvec3 seen = corner + box.axes * (0.03 * away) - box.centre;
    const BoxShape<double> grown = placed<double>(box, 0.03, glm::dvec3(0.0)).shape;
    EXPECT_NEAR(simd::surface_at(grown, simd::Vec<double>{seen.x, seen.y, seen.z}).distance, 0, 1e-12);
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
