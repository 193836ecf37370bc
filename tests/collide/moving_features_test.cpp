#include "collide/oracle/moving_features.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "states.h"

namespace collide::test {

using namespace collide::oracle;
namespace THIS_FILE {

MovingPoint still(const glm::dvec3& p) { return {p, p}; }
MovingPoint moving(const glm::dvec3& p, const glm::dvec3& by) { return {p, p + by}; }
glm::dvec3 at(const MovingPoint& p, double t) { return p.from * (1 - t) + p.to * t; }

/// Returns a point whose coordinates are at most `largest`.
glm::dvec3 random_point(std::mt19937& random, double largest) {
  std::uniform_real_distribution<double> coordinate(-largest, largest);
  return {coordinate(random), coordinate(random), coordinate(random)};
}

struct Four {
  std::array<MovingPoint, 4> v;
  auto vertex_face() const { return passage_of({MovingFeatures::Kind::vertex_face, v}); }
  auto edge_edge() const { return passage_of({MovingFeatures::Kind::edge_edge, v}); }
};
const std::array<MovingPoint, 3> floor_face{still({0, 0, 0}), still({0, 0, 4}), still({4, 0, 0})};  // faces up
Four over_floor(const MovingPoint& p) { return {{p, floor_face[0], floor_face[1], floor_face[2]}}; }

TEST(VertexThroughFace, PassesAtTheExpectedTime) {
  const auto down = over_floor(moving({1, 3, 1}, {0, -4, 0})).vertex_face();
  ASSERT_TRUE(down);
  EXPECT_NEAR(down->time, 0.75, 1e-9);
  EXPECT_TRUE(down->inward);
  const auto up = over_floor(moving({1, -1, 1}, {0, 4, 0})).vertex_face();
  ASSERT_TRUE(up);
  EXPECT_NEAR(up->time, 0.25, 1e-9);
  EXPECT_FALSE(up->inward);
  EXPECT_FALSE(over_floor(moving({3, 3, 3}, {0, -4, 0})).vertex_face());
}

TEST(VertexThroughFace, SidesAndCornersBelongToTheFace) {
  for (const glm::dvec3& p : {glm::dvec3(0, 1, 0), glm::dvec3(2, 1, 2), glm::dvec3(0, 1, 1.3), glm::dvec3(4, 1, 0)}) {
    EXPECT_TRUE(over_floor(moving(p, {0, -2, 0})).vertex_face()) << p.x << ' ' << p.z;
  }
}

TEST(VertexThroughFace, InThePlaneCountsAsOutside) {
  const glm::dvec3 above(1, 1, 1), on(1, 0, 1), below(1, -1, 1);
  const auto passes = [](const glm::dvec3& from, const glm::dvec3& to) {
    return over_floor({from, to}).vertex_face().has_value();
  };
  EXPECT_FALSE(passes(above, on));
  EXPECT_TRUE(passes(on, below));
  EXPECT_TRUE(passes(below, on));
  EXPECT_FALSE(passes(on, above));
  EXPECT_FALSE(passes(on, on + glm::dvec3(0.5, 0, 0)));
}

TEST(VertexThroughFace, FindsTheFirstOfTwoPassagesInOneStep) {
  // The face rotates up about one side, and the vertex approaches that side. The height of the face at the vertex is
  // t (1 - t).
  for (const double height : {0.1875, 0.2501}) {
    const Four swing{{moving({1, height, 1}, {-1, 0, 0}), floor_face[0], floor_face[1], moving({4, 0, 0}, {0, 4, 0})}};
    const auto first = swing.vertex_face();
    ASSERT_EQ(first.has_value(), height < 0.25);
    if (!first) continue;
    EXPECT_NEAR(first->time, 0.25, 1e-9);
    EXPECT_TRUE(first->inward);
  }
}

TEST(EdgeThroughEdge, PassesAtTheExpectedTime) {
  const Four cross{
      {moving({-1, 1, 0}, {0, -4, 0}), moving({1, 1, 0}, {0, -4, 0}), still({0, 0, -1}), still({0, 0, 1})}};
  const auto passage = cross.edge_edge();
  ASSERT_TRUE(passage);
  EXPECT_NEAR(passage->time, 0.25, 1e-9);
  const Four beside{
      {moving({1, 1, 0}, {0, -4, 0}), moving({3, 1, 0}, {0, -4, 0}), still({0, 0, -1}), still({0, 0, 1})}};
  EXPECT_FALSE(beside.edge_edge());
}

TEST(EdgeThroughEdge, ParallelEdgesInOnePlaneDoNotPass) {
  const Four parallel{
      {moving({-1, 1, 0}, {0, -4, 0}), moving({1, 1, 0}, {0, -4, 0}), still({-2, 0, 0}), still({2, 0, 0})}};
  EXPECT_FALSE(parallel.edge_edge());
}

/// Returns a point near x and z, exactly in the plane y = x + z: its coordinates have 20 binary places.
glm::dvec3 in_plane(std::mt19937& random, double x, double z) {
  const auto rounded = [&](double middle) {
    return std::round((middle + 0.1 * random_point(random, 1).x) * 0x1p20) * 0x1p-20;
  };
  const double exact_x = rounded(x), exact_z = rounded(z);
  return {exact_x, exact_x + exact_z, exact_z};
}

/// Products of three differences of such coordinates do not fit into a double.
TEST(VertexThroughFace, InThePlaneCountsAsOutsideEvenIfProductsAreRounded) {
  std::mt19937 random(25);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 a = in_plane(random, 0.2, 0.2), b = in_plane(random, 0.5, 1.2), c = in_plane(random, 1.2, 0.2);
    const glm::dvec3 p = in_plane(random, 0.6, 0.5);
    const auto passes = [&](const glm::dvec3& by) {
      return Four{{moving(p, by), still(a), still(b), still(c)}}.vertex_face().has_value();
    };
    EXPECT_FALSE(passes({0, 0.5, 0})) << i;
    EXPECT_TRUE(passes({0, -0.5, 0})) << i;
    EXPECT_FALSE(passes({0.0625, 0.0625, 0})) << i;
  }
}

TEST(EdgeThroughEdge, InOnePlaneCountsAsPositiveEvenIfProductsAreRounded) {
  std::mt19937 random(26);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 p = in_plane(random, 0.2, 0.2), q = in_plane(random, 0.8, 0.8);
    const glm::dvec3 u = in_plane(random, 0.2, 0.8), v = in_plane(random, 0.8, 0.2);
    const auto passes = [&](const glm::dvec3& by) {
      return Four{{moving(p, by), moving(q, by), still(u), still(v)}}.edge_edge().has_value();
    };
    EXPECT_FALSE(passes({0, -0.5, 0})) << i;
    EXPECT_TRUE(passes({0, 0.5, 0})) << i;
    EXPECT_FALSE(passes({0.0625, 0.0625, 0})) << i;
  }
}

// The reference: at many times, in double, the side, and the smallest barycentric coordinate or edge parameter.

double vertex_face_margin(const Four& four, double t, double& side) {
  const glm::dvec3 p = at(four.v[0], t), a = at(four.v[1], t), b = at(four.v[2], t), c = at(four.v[3], t);
  const glm::dvec3 n = glm::cross(b - a, c - a);
  side = glm::dot(p - a, n);
  const double area = glm::dot(n, n);
  return std::min({glm::dot(n, glm::cross(b - p, c - p)), glm::dot(n, glm::cross(c - p, a - p)),
                   glm::dot(n, glm::cross(a - p, b - p))}) /
         area;
}
double edge_edge_margin(const Four& four, double t, double& side) {
  const glm::dvec3 p = at(four.v[0], t), u = at(four.v[2], t), d = at(four.v[1], t) - p, e = at(four.v[3], t) - u;
  const glm::dvec3 n = glm::cross(d, e);
  side = glm::dot(u - p, n);
  const double s = glm::dot(glm::cross(u - p, e), n) / glm::dot(n, n);
  const double r = glm::dot(glm::cross(u - p, d), n) / glm::dot(n, n);
  return std::min({s, 1 - s, r, 1 - r});
}

/// Counts the changes of side between two times at both of which the features cross far from their borders.
template <class Margin>
int count_clear_passages(const Four& four, const Margin& margin) {
  constexpr int samples = 1000;
  constexpr double clear = 1e-5;  // m^3, of a side: far more than rounding errors
  int changes = 0;
  double side_before = 0, within_before = 0;
  for (int i = 0; i <= samples; ++i) {
    double side;
    const double within = margin(four, static_cast<double>(i) / samples, side);
    if (std::abs(side) < clear) continue;
    if (side * side_before < 0 && std::min(within, within_before) > 0.1) ++changes;
    side_before = side;
    within_before = within;
  }
  return changes;
}

Four random_four(std::mt19937& random, double speed, const glm::dvec3& origin) {
  Four four;
  for (MovingPoint& p : four.v) {
    p.from = origin + random_point(random, 1);
    p.to = p.from + random_point(random, speed);
  }
  return four;
}

/// Expects that every passage that samples show is reported, and that the features touch at a reported time.
template <class Find, class Margin>
void compare_with_samples(const Find& find, const Margin& margin) {
  std::mt19937 random(23);
  int reported = 0, sampled = 0;
  for (const double speed : {0.3, 2.0, 30.0}) {
    for (const glm::dvec3& origin : {glm::dvec3(0), glm::dvec3(1e5, -1e5, 1e5)}) {
      for (int i = 0; i < 1500; ++i) {
        const Four four = random_four(random, speed, origin);
        const std::optional<Passage> passage = find(four);
        if (count_clear_passages(four, margin) > 0) {
          ++sampled;
          ASSERT_TRUE(passage) << speed << ' ' << i;
        }
        if (!passage) continue;
        ++reported;
        double side;
        ASSERT_GT(margin(four, passage->time, side), -1e-3);
        ASSERT_LT(std::abs(side), 1e-5 * (1 + std::pow(speed, 3)));
      }
    }
  }
  EXPECT_GT(sampled, 200);
  EXPECT_LT(reported, 2 * sampled);
}

TEST(VertexThroughFace, AgreesWithSamplesInTime) {
  compare_with_samples([](const Four& four) { return four.vertex_face(); }, vertex_face_margin);
}
TEST(EdgeThroughEdge, AgreesWithSamplesInTime) {
  compare_with_samples([](const Four& four) { return four.edge_edge(); }, edge_edge_margin);
}

TEST(VertexThroughFace, FindsPassagesOfPointsOnALattice) {
  std::mt19937 random(24);
  const auto whole = [&] { return static_cast<double>(random() % 4); };
  int sampled = 0;
  for (int i = 0; i < 20000; ++i) {
    Four four;
    for (MovingPoint& p : four.v) p = {{whole(), whole(), whole()}, {whole(), whole(), whole()}};
    if (count_clear_passages(four, vertex_face_margin) == 0) continue;
    ++sampled;
    ASSERT_TRUE(four.vertex_face()) << i;
  }
  EXPECT_GT(sampled, 300);
}

}  // namespace THIS_FILE
}  // namespace collide::test
