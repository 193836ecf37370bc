// Compares the predicates with rationals. Points have few values, so that every tie occurs, or many values, lie far
// from the origin, or have all exponents.

#include "collide/oracle/exact_predicates.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "collide/oracle/exact_arithmetic.h"
#include "states.h"

namespace collide::test {

using namespace collide::oracle;
namespace THIS_FILE {

using Exact = std::array<mpq_class, 3>;

Exact exact(const glm::vec3& p) { return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)}; }
Exact minus(const Exact& a, const Exact& b) {
  return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
Exact vector_product(const Exact& a, const Exact& b) {
  return {mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
          mpq_class(a[0] * b[1] - a[1] * b[0])};
}
mpq_class product(const Exact& a, const Exact& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Exact normal_of(const Exact& a, const Exact& b, const Exact& c) { return vector_product(minus(b, a), minus(c, a)); }

using Points = std::vector<glm::vec3>;
struct Source {
  std::string name;
  std::function<float(std::mt19937&)> coordinate;
};
const std::vector<Source>& sources() {
  static const std::vector<Source> all{
      {"few values", [](std::mt19937& random) { return static_cast<float>(random() % 4); }},
      {"many values", [](std::mt19937& random) { return uniform(random, -1, 1); }},
      {"far away", [](std::mt19937& random) { return 1e6f + uniform(random, -1, 1); }},
      {"all exponents",
       [](std::mt19937& random) {
         const float value = uniform(random, -1, 1);
         return std::ldexp(value, static_cast<int>(random() % 250) - 125);
       }},
      {"nearly flat", [](std::mt19937& random) { return 1 + static_cast<float>(random() % 3) * 0x1p-23f; }},
  };
  return all;
}
template <class Check>
void for_each_four(int times, const Check& check) {
  std::mt19937 random(22);
  for (const Source& source : sources()) {
    SCOPED_TRACE(source.name);
    for (int i = 0; i < times; ++i) {
      Points points(5);
      for (glm::vec3& p : points) {
        for (int axis = 0; axis < 3; ++axis) p[axis] = source.coordinate(random);
      }
      check(points);
    }
  }
}

TEST(ExactPredicates, SignsAgreeWithRationals) {
  int zeros = 0;
  for_each_four(3000, [&](const Points& v) {
    const Exact a = exact(v[0]), b = exact(v[1]), c = exact(v[2]), p = exact(v[3]);
    const Exact normal = normal_of(a, b, c);
    const int side = side_of_plane(v[0], v[1], v[2], v[3]);
    ASSERT_EQ(side, sgn(product(minus(p, a), normal)));
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(sign_of_normal(axis, v[0], v[1], v[2]), sgn(normal[static_cast<std::size_t>(axis)]));
    }
    zeros += side == 0;
  });
  EXPECT_GT(zeros, 500);
}

/// Returns the barycentric coordinates of the projection of p, times the squared length of the normal.
Exact barycentric(const Exact& p, const Exact& a, const Exact& b, const Exact& c) {
  const Exact n = normal_of(a, b, c);
  return {product(n, normal_of(p, b, c)), product(n, normal_of(p, c, a)), product(n, normal_of(p, a, b))};
}

TEST(ExactPredicates, OnTriangleAgreesWithRationals) {
  int on = 0;
  for_each_four(3000, [&](const Points& v) {
    const Exact a = exact(v[0]), b = exact(v[1]), c = exact(v[2]), p = exact(v[3]);
    const Exact n = normal_of(a, b, c), weights = barycentric(p, a, b, c);
    const bool expected = product(n, n) != 0 && product(minus(p, a), n) == 0 &&
                          std::all_of(weights.begin(), weights.end(), [](const auto& w) { return w >= 0; });
    ASSERT_EQ(on_triangle(v[3], v[0], v[1], v[2]), expected);
    on += expected;
  });
  EXPECT_GT(on, 50);
}

TEST(ExactPredicates, SegmentCrossingAgreesWithRationals) {
  int through = 0, ties = 0;
  for_each_four(6000, [&](const Points& v) {
    const Exact a = exact(v[0]), b = exact(v[1]), c = exact(v[2]), p = exact(v[3]), q = exact(v[4]);
    const Exact n = normal_of(a, b, c);
    const mpq_class from = product(minus(p, a), n), to = product(minus(q, a), n);
    const SegmentCrossing crossing = segment_crossing(v[3], v[4], v[0], v[1], v[2]);
    if (sgn(from) * sgn(to) >= 0) {
      ASSERT_EQ(crossing.plus, 0);
      ASSERT_EQ(crossing.minus, 0);
      return;
    }
    const mpq_class t = from / (from - to);
    Exact hit;
    for (std::size_t axis = 0; axis < 3; ++axis) hit[axis] = p[axis] + (q[axis] - p[axis]) * t;
    const Exact weights = barycentric(hit, a, b, c);
    const mpq_class smallest = std::min({weights[0], weights[1], weights[2]});
    if (smallest == 0) {  // on a side or a corner: the result depends on how p is moved
      ++ties;
      ASSERT_TRUE(crossing.meets[0] == (weights[2] == 0) && crossing.meets[1] == (weights[0] == 0) &&
                  crossing.meets[2] == (weights[1] == 0));
      ASSERT_TRUE(crossing.plus == 0 || crossing.plus == sgn(from));
      ASSERT_TRUE(crossing.minus == 0 || crossing.minus == sgn(from));
    } else {
      ASSERT_EQ(crossing.plus, smallest > 0 ? sgn(from) : 0);
      ASSERT_EQ(crossing.minus, crossing.plus);
      through += smallest > 0;
    }
  });
  EXPECT_GT(through, 200);
  EXPECT_GT(ties, 200);
}

TEST(ExactPredicates, RayCrossingsSumToTheWindingNumberOfATetrahedron) {
  int inside = 0, level = 0;  // level: corners that lie on the line of the ray
  for_each_four(6000, [&](const Points& v) {
    const int orientation = side_of_plane(v[0], v[1], v[2], v[3]);
    if (orientation == 0) return;
    const std::array<std::array<std::size_t, 3>, 4> faces{{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
    int windings = 0, inner_sides = 0;
    bool on = false;
    for (const auto& [i, j, k] : faces) {
      windings += ray_crossing(v[4], v[i], v[j], v[k]);
      inner_sides += side_of_plane(v[i], v[j], v[k], v[4]) == orientation;
      on = on || on_triangle(v[4], v[i], v[j], v[k]);
    }
    if (on) return;
    ASSERT_EQ(windings, inner_sides == 4 ? -orientation : 0);
    inside += inner_sides == 4;
    for (std::size_t i = 0; i < 4; ++i) level += v[i].y == v[4].y && v[i].z == v[4].z;
  });
  EXPECT_GT(inside, 30);
  EXPECT_GT(level, 100);
}

TEST(Integer, IsMadeOfAll64Bits) {
  for (const char* digits : {"0", "1", "fedcba9876543210", "ffffffffffffffff"})
    EXPECT_EQ(integer_of(std::strtoull(digits, nullptr, 16)).get_str(16), digits);
}

}  // namespace THIS_FILE
}  // namespace collide::test
