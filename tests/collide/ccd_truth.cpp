#include "ccd_truth.h"

#include <algorithm>

#include <gmpxx.h>

namespace collide::test {

namespace {

using Rational = mpq_class;
/// The coefficients of 1, t, t^2 ...; the last one is not 0.
using Polynomial = std::vector<Rational>;
using Point = std::array<Polynomial, 3>;
using Points = std::array<Point, 4>;

Polynomial trimmed(Polynomial p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  return p;
}
Polynomial operator-(Polynomial a, const Polynomial& b) {
  a.resize(std::max(a.size(), b.size()));
  for (std::size_t k = 0; k < b.size(); ++k) a[k] -= b[k];
  return trimmed(std::move(a));
}
Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial product(a.empty() || b.empty() ? 0 : a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) product[i + k] += a[i] * b[k];
  }
  return product;
}
Rational value(const Polynomial& p, const Rational& t) {
  Rational sum = 0;
  for (std::size_t k = p.size(); k-- > 0;) sum = sum * t + p[k];
  return sum;
}
/// Returns a / b and leaves the remainder in a.
Polynomial divide(Polynomial& a, const Polynomial& b) {
  Polynomial quotient(a.size() < b.size() ? 0 : a.size() - b.size() + 1);
  for (std::size_t at = quotient.size(); at-- > 0; a.pop_back()) {
    quotient[at] = a.back() / b.back();
    for (std::size_t k = 0; k < b.size(); ++k) a[at + k] -= quotient[at] * b[k];
  }
  a = trimmed(std::move(a));
  return quotient;
}
Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t k = 1; k < p.size(); ++k) d.push_back(p[k] * static_cast<unsigned>(k));
  return d;
}
Polynomial common_divisor(Polynomial a, Polynomial b) {
  while (!b.empty()) {
    divide(a, b);
    std::swap(a, b);
  }
  return a;
}

/// Returns how many different roots a polynomial has in (low, high].
int count_roots(const Polynomial& p, const Rational& low, const Rational& high) {
  Polynomial a = p, b = derivative(p);
  if (const Polynomial divisor = common_divisor(a, b); divisor.size() > 1) {
    a = divide(a, divisor);
    b = derivative(a);
  }
  int changes[2] = {0, 0}, last[2] = {sgn(value(a, low)), sgn(value(a, high))};
  while (!b.empty()) {
    for (const int end : {0, 1}) {
      const int sign = sgn(value(b, end == 0 ? low : high));
      if (sign != 0 && sign == -last[end]) ++changes[end];
      if (sign != 0) last[end] = sign;
    }
    divide(a, b);
    for (Rational& x : a) x = -x;
    std::swap(a, b);
  }
  return changes[0] - changes[1];
}

/// The only root of p in (low, high], or low itself where both are equal.
struct Root {
  Polynomial p;
  Rational low, high;

  void halve() {
    const Rational middle = (low + high) / 2;
    if (value(p, middle) == 0) {
      low = high = middle;
    } else {
      (count_roots(p, low, middle) == 0 ? low : high) = middle;
    }
  }
  int sign(const Polynomial& q) {
    if (q.empty()) return 0;
    if (low != high) {
      if (const Polynomial both = common_divisor(p, q); both.size() > 1 && count_roots(both, low, high) > 0) return 0;
    }
    while (low != high && (value(q, low) == 0 || count_roots(q, low, high) > 0)) halve();
    return sgn(value(q, high));
  }
};

void find_roots(const Polynomial& p, const Rational& low, const Rational& high, std::vector<Root>& roots) {
  const int count = count_roots(p, low, high);
  if (count == 1) roots.push_back({p, value(p, high) == 0 ? high : low, high});
  if (count < 2) return;
  const Rational middle = (low + high) / 2;
  find_roots(p, low, middle, roots);
  find_roots(p, middle, high, roots);
}

Points points_of(const Query& query) {
  Points points;
  for (std::size_t k = 0; k < 4; ++k) {
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      const Rational from = query.points[k].from[axis], to = query.points[k].to[axis];
      points[k][static_cast<std::size_t>(axis)] = trimmed({from, Rational(to - from)});
    }
  }
  return points;
}

/// Returns the values of a polynomial shortly before and after its root.
std::array<Rational, 2> around(Root root, const Polynomial& p) {
  while (root.low != root.high && value(p, root.low) == 0) root.halve();
  if (root.low != root.high) return {value(p, root.low), value(p, root.high)};
  const Rational& at = root.high;
  for (Rational step = 1;; step /= 2) {
    const Rational before = at - step, after = at + step;
    if (value(p, before) != 0 && count_roots(p, before, after) == 1) return {value(p, before), value(p, after)};
  }
}

/// Returns twice the area of three points, seen along an axis.
Polynomial area(const Point& a, const Point& b, const Point& c, std::size_t axis) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  return (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
}
Polynomial volume(const Points& p) {
  Polynomial sum;
  for (std::size_t axis = 0; axis < 3; ++axis) sum = sum - (p[1][axis] - p[0][axis]) * area(p[1], p[2], p[3], axis);
  return sum;
}

/// All polynomials on whose signs the answer depends.
struct Signs {
  Polynomial side;
  // By axis; areas[axis][k] is of the points without point k, in their order.
  std::array<std::array<Polynomial, 4>, 3> areas;
  std::array<std::array<std::array<Polynomial, 4>, 4>, 3> differences;  // by axis, of point i less point k
  std::array<Polynomial, 3> normals;                                    // of two edges

  explicit Signs(const Points& p) : side(volume(p)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t a = k == 0 ? 1 : 0, b = k <= 1 ? 2 : 1, c = k <= 2 ? 3 : 2;
        areas[axis][k] = area(p[a], p[b], p[c], axis);
        for (std::size_t i = 0; i < 4; ++i) differences[axis][i][k] = p[i][axis] - p[k][axis];
      }
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      normals[axis] = (p[1][u] - p[0][u]) * (p[3][v] - p[2][v]) - (p[1][v] - p[0][v]) * (p[3][u] - p[2][u]);
    }
  }

  /// Returns true if, along every axis, the range of the first `count` points and that of the others overlap.
  bool ranges_overlap(Root& root, std::size_t count) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bool below = true, above = true;  // all of the first are below, or above, all others
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = count; k < 4; ++k) {
          const int sign = root.sign(differences[axis][i][k]);
          below = below && sign < 0;
          above = above && sign > 0;
        }
      }
      if (below || above) return false;
    }
    return true;
  }

  bool meet_at(Root& root, Query::Kind kind) const {
    if (root.sign(side) != 0) return false;
    const bool face = kind == Query::Kind::vertex_face;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int normal = root.sign(face ? areas[axis][0] : normals[axis]);
      if (normal == 0) continue;
      const int without1 = root.sign(areas[axis][1]), without2 = root.sign(areas[axis][2]),
                without3 = root.sign(areas[axis][3]);
      // p23, 3p2 -> -p31, p12 must turn as 123 does.
      if (face) return without1 * normal >= 0 && without2 * normal <= 0 && without3 * normal >= 0;
      const int without0 = root.sign(areas[axis][0]);
      return without2 * without3 <= 0 && without0 * without1 <= 0;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t k = 0; k < 4; ++k) {
        if (root.sign(areas[axis][k]) != 0) return false;  // not in one line
      }
    }
    return ranges_overlap(root, face ? 1 : 2);
  }

  std::vector<Polynomial> all() const {
    std::vector<Polynomial> all{side};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.push_back(normals[axis]);
      all.insert(all.end(), areas[axis].begin(), areas[axis].end());
      for (const auto& of_point : differences[axis]) all.insert(all.end(), of_point.begin(), of_point.end());
    }
    return all;
  }
};

}  // namespace

/// The times of meetings are a closed set, and where they begin, one of the polynomials has a root.
Truth truth_of(const Query& query) {
  const Signs signs(points_of(query));
  Truth truth;
  const bool planar = signs.side.empty();
  std::vector<Root> times{{{}, 0, 0}};
  for (const Polynomial& p : planar ? signs.all() : std::vector<Polynomial>{signs.side}) {
    if (!p.empty()) find_roots(p, 0, 1, times);
  }
  for (Root& root : times) {
    if (!signs.meet_at(root, query.kind)) continue;
    while (root.high - root.low > Rational(1e-15)) root.halve();
    const double time = root.high.get_d();
    truth.first_meeting = std::min(time, truth.first_meeting.value_or(time));
    if (planar || truth.first_passage) continue;
    const bool starts = root.low == root.high && root.high == 0, ends = root.low == root.high && root.high == 1;
    const auto [before, after] = around(root, signs.side);
    if ((!starts && before < 0) || (!ends && after < 0))
      truth.first_passage = oracle::Passage{time, starts || before > 0};
  }
  return truth;
}

}  // namespace collide::test
