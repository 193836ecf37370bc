// The distance functions of the solids against brute force: points sampled all over their surfaces.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>

#include "softbody/contact/solid_shapes.h"
#include "softbody/contact/solid_surface.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

constexpr double pi = 3.14159265358979323846;

const SolidSphere sphere{.centre = {0.25, -0.5, 1}, .radius = 0.75};
const SolidBox box{
    .centre = {0.5, 0.25, -0.5},
    .half_size = {0.7, 0.2, 0.4},
    .axes = glm::dmat3(glm::dvec3(0.6, 0.8, 0), glm::dvec3(-0.64, 0.48, 0.6), glm::dvec3(0.48, -0.36, 0.8))};
const SolidCapsule capsule{.from = {-0.5, 0, 0.25}, .to = {0.5, 0.75, -0.25}, .radius = 0.3};
const SolidCapsule ball{.from = {0.25, -0.5, 1}, .to = {0.25, -0.5, 1}, .radius = 0.75};

using Points = std::vector<glm::dvec3>;

Points sphere_points(const glm::dvec3& centre, double radius) {
  Points points;
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 120; ++j) {
      const double a = pi * (i + 0.5) / 60, b = 2 * pi * j / 120;
      points.push_back(centre + radius * glm::dvec3(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b)));
    }
  return points;
}

Points box_points(const SolidBox& b) {
  Points points;
  for (int face = 0; face < 6; ++face)
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; j <= 60; ++j) {
        glm::dvec3 p;
        p[face % 3] = face < 3 ? 1 : -1;
        p[(face + 1) % 3] = i / 30.0 - 1;
        p[(face + 2) % 3] = j / 30.0 - 1;
        points.push_back(b.centre + b.axes * (p * b.half_size));
      }
  return points;
}

/// Spheres strung along the segment; what of them lies inside others is inside the capsule.
Points capsule_points(const SolidCapsule& c) {
  Points points;
  for (int i = 0; i <= 60; ++i)
    for (const glm::dvec3& p : sphere_points(c.from + i / 60.0 * (c.to - c.from), c.radius)) points.push_back(p);
  return points;
}

double nearest(const Points& points, const glm::dvec3& to) {
  double least = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& p : points) least = std::min(least, glm::distance(p, to));
  return least;
}

/// coarse: how far apart the points are at most.
void expect_distance_to(const Solid& solid, const Points& points, double coarse) {
  std::mt19937 random(21);
  int outside = 0;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 p = random_vector(random, 2);
    const SolidSurface s = surface_at(solid, p);
    EXPECT_NEAR(glm::length(s.normal), 1, 1e-12);
    const glm::dvec3 foot = p - s.distance * s.normal;
    EXPECT_NEAR(surface_at(solid, foot).distance, 0, 1e-12) << "it leads to the surface";
    if (s.distance < 0) continue;  // inside, where the points of strung spheres are no surface
    ++outside;
    EXPECT_LE(s.distance, nearest(points, p) + 1e-12) << "none is nearer";
    EXPECT_GT(s.distance, nearest(points, p) - coarse);
    for (std::size_t k = 0; k < points.size(); k += 7)
      ASSERT_LE(glm::dot(points[k] - foot, s.normal), 1e-12) << "all of it lies behind the plane at the foot";
  }
  EXPECT_GT(outside, 150);
}

TEST(SolidShapes, OfASphere) { expect_distance_to({sphere}, sphere_points(sphere.centre, sphere.radius), 0.06); }
TEST(SolidShapes, OfABox) { expect_distance_to({box}, box_points(box), 0.06); }
TEST(SolidShapes, OfACapsule) { expect_distance_to({capsule}, capsule_points(capsule), 0.06); }
TEST(SolidShapes, OfACapsuleWithoutLength) { expect_distance_to({ball}, sphere_points(ball.from, ball.radius), 0.06); }

TEST(SolidShapes, InsideABoxTheNearestFaceCounts) {
  const Points points = box_points(box);
  std::mt19937 random(22);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 p = box.centre + box.axes * (random_vector(random, 1) * box.half_size);
    const SolidSurface s = surface_at({box}, p);
    EXPECT_LE(s.distance, 0);
    EXPECT_LE(-s.distance, nearest(points, p) + 1e-12);
    EXPECT_GT(-s.distance, nearest(points, p) - 0.06);
    EXPECT_NEAR(surface_at({box}, p - s.distance * s.normal).distance, 0, 1e-12);
  }
}

TEST(SolidShapes, OfAPlaneAnywhere) {
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
