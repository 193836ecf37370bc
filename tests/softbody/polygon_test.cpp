// Polygons into triangles: areas add up, nothing lies outside, sides stay.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "softbody/mesh/polygon.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

using Polygon = std::vector<glm::dvec3>;

glm::dvec3 area_vector(const Polygon& p) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < p.size(); ++i) sum += 0.5 * glm::cross(p[i] - p[0], p[i + 1] - p[0]);
  return sum;
}

/// Expects that triangles cover a flat polygon exactly: none is turned over, and their areas add up to its.
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

TEST(Triangulate, CoversConcavePolygonsInEveryPlane) {
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

TEST(Triangulate, KeepsCornersOnAStraightLine) {
  const Polygon p{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 10, 0}, {0, 10, 0}};  // the shortest cut runs along the line
  expect_covered(p);
  std::vector<int> sides(p.size(), 0);  // how many triangles have the side from a corner to the next
  for (const Triangle& t : triangulate(p)) {
    EXPECT_GT(glm::length(area_vector({p[t[0]], p[t[1]], p[t[2]]})), 0.1) << "none without area";
    for (std::size_t k = 0; k < 3; ++k)
      if ((t[k] + 1) % p.size() == t[(k + 1) % 3]) ++sides[t[k]];
  }
  EXPECT_EQ(sides, std::vector<int>(p.size(), 1)) << "each side has one triangle, so that neighbours stay joined";
}

TEST(Triangulate, CutsThroughNoCorner) {
  const Polygon p{{0, 0, 0}, {1, -1, 0}, {2, 0, 0}, {6, 1, 0}, {6, 4, 0}, {1, 0, 0}, {-4, 4, 0}, {-4, 1, 0}};
  expect_covered(p);
  for (const auto& [a, b, c] : triangulate(p)) EXPECT_GT(glm::length(area_vector({p[a], p[b], p[c]})), 0.1);
}

TEST(Triangulate, CutsPolygonsThatCrossThemselvesOrHaveNoArea) {
  EXPECT_EQ(triangulate(Polygon{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2u);
  EXPECT_EQ(triangulate(Polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}}).size(), 3u);
  EXPECT_EQ(triangulate(Polygon(7, glm::dvec3(1.0))).size(), 5u);
}

Polygons polygons(const std::vector<std::vector<Index>>& each) {
  Polygons all;
  for (const auto& corners : each) {
    all.corners.insert(all.corners.end(), corners.begin(), corners.end());
    all.ends.push_back(all.corners.size());
  }
  return all;
}

/// Expects that the triangles of each polygon are as many as they have to be, and have its sides.
void expect_cut(const std::vector<std::vector<Index>>& each, const Polygon& vertices) {
  const auto [triangles, polygon] = triangulate(polygons(each), vertices);
  ASSERT_EQ(triangles.size(), polygon.size());
  std::map<Edge, int> faces;
  std::map<std::array<Index, 3>, int> sides;  // of triangles: polygon, from, to
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      EXPECT_LE(++faces[ordered(a, b)], 2);
      ++sides[{polygon[t], a, b}];
    }
  for (Index p = 0; p < each.size(); ++p) {
    EXPECT_EQ(std::ranges::count(polygon, p), std::ptrdiff_t(each[p].size() - 2));
    for (std::size_t i = 0; i < each[p].size(); ++i) {
      const Index a = each[p][i], b = each[p][(i + 1) % each[p].size()];
      EXPECT_EQ((sides[{p, a, b}]), 1) << "of polygon " << p << " from " << a << " to " << b;
    }
  }
}

TEST(Triangulate, CutsPolygonsOfTheSameCornersApart) {
  for (const Index corners : {4u, 5u, 12u, 60u}) {
    Polygon vertices;
    std::vector<Index> there, back;
    for (Index i = 0; i < corners; ++i) {
      const double angle = 6.28 * i / corners;
      vertices.emplace_back(std::cos(angle), std::sin(angle), 0.1 * (i % 2));
      there.push_back(i);
      back.insert(back.begin(), i);
    }
    expect_cut({there, back}, vertices);
  }
}

TEST(Triangulate, KeepsTheOnlyRightCutOfAConcavePolygon) {
  const Polygon vertices{{0, 0, 0}, {2, 0, 0}, {0.5, 0, -0.5}, {0, 0, -2}, {1, 1, 0}, {-1, 1, -1}};
  const std::vector<Index> arrowhead{0, 1, 2, 3}, kite{0, 4, 2, 5};
  for (const auto& both : {std::vector{arrowhead, kite}, {kite, arrowhead}}) {
    expect_cut(both, vertices);
    const auto [triangles, polygon] = triangulate(polygons(both), vertices);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      if (both[polygon[t]] == kite) continue;
      EXPECT_GT(area_vector({vertices[a], vertices[b], vertices[c]}).y, 0) << "none is turned over";
    }
  }
}

TEST(Triangulate, CutsPolygonsThatDoNotMeetAsIfEachWereAlone) {
  std::mt19937 random(11);
  std::vector<std::vector<Index>> each;
  Polygon vertices;
  for (int i = 0; i < 200; ++i) {
    each.emplace_back();
    for (int k = 0; k < 3 + i % 6; ++k) {
      each.back().push_back(static_cast<Index>(vertices.size()));
      vertices.push_back(random_vector(random, 1));
    }
  }
  const auto [triangles, polygon] = triangulate(polygons(each), vertices);
  std::size_t t = 0;
  for (std::size_t p = 0; p < each.size(); ++p) {
    Polygon corners;
    for (const Index v : each[p]) corners.push_back(vertices[v]);
    for (const auto& [a, b, c] : triangulate(corners)) {
      EXPECT_EQ(polygon[t], p);
      EXPECT_EQ(triangles[t++], (Triangle{each[p][a], each[p][b], each[p][c]}));
    }
  }
}

/// Returns true if cuts of quads can all differ and run along no side; tries both cuts of each.
bool can_be_cut(const std::vector<std::vector<Index>>& quads, const std::set<Edge>& used, std::size_t first = 0) {
  if (first == quads.size()) return true;
  for (const std::size_t from : {0u, 1u}) {
    std::set<Edge> now = used;
    if (now.insert(ordered(quads[first][from], quads[first][from + 2])).second && can_be_cut(quads, now, first + 1))
      return true;
  }
  return false;
}

TEST(Triangulate, CutsQuadsIfThatIsPossible) {
  std::mt19937 random(3);
  int cut = 0, not_cut = 0;
  for (int round = 0; round < 2000; ++round) {
    Polygon vertices;
    for (int v = 0; v < 9; ++v) vertices.push_back(random_vector(random, 1));
    std::vector<std::vector<Index>> quads;
    std::set<Edge> sides;
    for (int q = 0; q < 9; ++q) {
      std::vector<Index> corners{0, 1, 2, 3, 4, 5, 6, 7, 8};
      std::shuffle(corners.begin(), corners.end(), random);
      corners.resize(4);
      if (std::ranges::any_of(std::array{0, 1, 2, 3}, [&](int i) {
            return sides.contains(ordered(corners[std::size_t(i)], corners[std::size_t(i + 1) % 4]));
          }))
        continue;  // each side has one face, so that any edge with more is a cut's
      quads.push_back(corners);
      for (std::size_t i = 0; i < 4; ++i) sides.insert(ordered(corners[i], corners[(i + 1) % 4]));
    }
    if (can_be_cut(quads, sides)) {
      expect_cut(quads, vertices);
      ++cut;
    } else {
      EXPECT_THROW(triangulate(polygons(quads), vertices), PolygonError);
      ++not_cut;
    }
  }
  EXPECT_GT(cut, 100);
  EXPECT_GT(not_cut, 100);
}

TEST(Triangulate, NamesAPolygonThatItCannotCut) {
  const Polygon vertices(4, glm::dvec3(0.0));
  try {
    triangulate(polygons({{0, 1, 2}, {1, 3, 2}, {0, 1, 3, 2}, {0, 2, 3, 1}, {0, 3, 1}}), vertices);
    FAIL() << "was cut";
  } catch (const PolygonError& error) {
    EXPECT_TRUE(error.polygon == 2 || error.polygon == 3) << error.polygon;
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
