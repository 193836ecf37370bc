// Polygons into triangles: areas add up, nothing lies outside, sides stay.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "softbody/polygon.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace {

using Polygon = std::vector<glm::dvec3>;

glm::dvec3 area_vector(const Polygon& p) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < p.size(); ++i) sum += 0.5 * glm::cross(p[i] - p[0], p[i + 1] - p[0]);
  return sum;
}

/// That triangles cover a flat polygon exactly: none is turned over, and their areas add up to its.
void expect_covered(const Polygon& p) {
  const auto triangles = triangulate(p);
  ASSERT_EQ(triangles.size(), p.size() - 2);
  const glm::dvec3 whole = area_vector(p);
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const double part = glm::dot(area_vector({p[a], p[b], p[c]}), glm::normalize(whole));
    EXPECT_GT(part, -1e-12 * glm::length(whole));
    sum += part;
  }
  EXPECT_NEAR(sum, glm::length(whole), 1e-12 * p.size() * glm::length(whole));
}

/// Every second corner of a star lies inwards, so that a fan from any corner would reach outside.
Polygon star(std::size_t tips, const glm::dvec3& u, const glm::dvec3& v) {
  Polygon p;
  for (std::size_t i = 0; i < 2 * tips; ++i) {
    const double angle = 3.14159265358979 * double(i) / double(tips), r = i % 2 ? 0.3 : 1.0;
    p.push_back(r * std::cos(angle) * u + r * std::sin(angle) * v + glm::dvec3(3, -2, 1));
  }
  return p;
}

TEST(Polygon, ConcaveOnesAreCoveredInEveryPlane) {
  for (const std::size_t tips : {2u, 3u, 5u, 40u})
    for (const auto& [u, v] : {std::pair(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)),
                               {{0, 1, 0}, {1, 0, 0}},
                               {glm::normalize(glm::dvec3(1, 2, 0)), glm::normalize(glm::dvec3(-2, 1, 3))}}) {
      Polygon p = star(tips, u, v);
      expect_covered(p);
      for (glm::dvec3& corner : p) corner *= 1e-3;
      expect_covered(p);
    }
  expect_covered({{0, 0, 0}, {2, 0, 0}, {0.5, 0, -0.5}, {0, 0, -2}});  // an arrowhead: only one diagonal is right
}

TEST(Polygon, CornersOnAStraightLineAreKept) {
  const Polygon p{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}};
  expect_covered(p);
  std::vector<int> sides(p.size(), 0);  // how many triangles have the side from a corner to the next
  for (const Triangle& t : triangulate(p))
    for (std::size_t k = 0; k < 3; ++k)
      if ((t[k] + 1) % p.size() == t[(k + 1) % 3]) ++sides[t[k]];
  EXPECT_EQ(sides, std::vector<int>(p.size(), 1)) << "each side has one triangle, so that neighbours stay joined";
}

TEST(Polygon, NoCutRunsThroughACorner) {
  const Polygon p{{0, 0, 0}, {1, -1, 0}, {2, 0, 0}, {6, 1, 0}, {6, 4, 0}, {1, 0, 0}, {-4, 4, 0}, {-4, 1, 0}};
  expect_covered(p);
  for (const auto& [a, b, c] : triangulate(p)) EXPECT_GT(glm::length(area_vector({p[a], p[b], p[c]})), 0.1);
}

TEST(Polygon, WhatCrossesItselfOrHasNoAreaIsCutAllTheSame) {
  EXPECT_EQ(triangulate(Polygon{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2u);
  EXPECT_EQ(triangulate(Polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}}).size(), 3u);
  EXPECT_EQ(triangulate(Polygon(7, glm::dvec3(1.0))).size(), 5u);
}

}  // namespace
}  // namespace softbody::test
