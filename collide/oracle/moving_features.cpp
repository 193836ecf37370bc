#include "collide/oracle/moving_features.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "collide/oracle/exact_arithmetic.h"

namespace collide::oracle {

namespace {

/// The relative motion of four points: three difference vectors.
template <class T>
using FeatureMotion = std::array<Vector<T, 1>, 3>;

template <class T>
Vector<T, 1> difference(const MovingPoint& a, const MovingPoint& b) {
  const auto component = [&](glm::length_t axis) {
    return Polynomial<T, 1>{{T(T(a.from[axis]) - T(b.from[axis])), T(T(a.to[axis]) - T(b.to[axis]))}};
  };
  return {component(0), component(1), component(2)};
}

template <class T>
using Weight = Polynomial<T, 4>;

/// A vertex p and a face abc, as the vectors a - p, b - p and c - p.
struct VertexFace {
  /// Returns the vectors from each vertex of the first feature to each vertex of the second.
  template <class T>
  static const FeatureMotion<T>& between(const FeatureMotion<T>& v) {
    return v;
  }
  /// Returns a polynomial with the sign of the side of p.
  template <class T>
  static Polynomial<T, 3> side(const FeatureMotion<T>& v) {
    return dot(v[0], cross(v[2], v[1]));
  }
  /// Returns the barycentric coordinates of the projection of p, times the squared length of the normal. None is
  /// negative while the projection lies on the face.
  template <class T>
  static std::array<Weight<T>, 3> weights(const FeatureMotion<T>& v) {
    const Vector<T, 2> a = cross(v[1], v[2]), b = cross(v[2], v[0]), c = cross(v[0], v[1]);
    const Vector<T, 2> normal = a + b + c;
    return {dot(normal, a), dot(normal, b), dot(normal, c)};
  }
};

/// Two edges pq and uv, as the vectors q - p, v - u and u - p.
struct EdgeEdge {
  template <class T>
  static std::array<Vector<T, 1>, 4> between(const FeatureMotion<T>& v) {
    return {v[2], v[2] - v[0], v[2] + v[1], v[2] + v[1] - v[0]};
  }
  template <class T>
  static Polynomial<T, 3> side(const FeatureMotion<T>& v) {
    return dot(v[2], cross(v[0], v[1]));
  }
  /// Returns s, 1 - s, r and 1 - r, where s and r are the parameters of the closest points of the two lines, times the
  /// squared length of the normal. None is negative while these points lie on the edges.
  template <class T>
  static std::array<Weight<T>, 4> weights(const FeatureMotion<T>& v) {
    const Vector<T, 2> normal = cross(v[0], v[1]);
    const Weight<T> length2 = dot(normal, normal);
    const Weight<T> along_p = dot(normal, cross(v[2], v[1])), along_u = dot(normal, cross(v[2], v[0]));
    return {along_p, length2 - along_p, along_u, length2 - along_u};
  }
};

/// Plain doubles decide most signs. The rounding error of a coefficient, in everything that is computed here, is less
/// than this number times d^N, where d is the largest coordinate difference and N the degree of the polynomial. Proof:
/// no coefficient is a sum of more than 432 products of at most four factors. Each product has at most 160 roundings,
/// 128 of them from halvings. 432 * 160 * 2^-53 is less than 2^-36.
constexpr double max_relative_error = 0x1p-35;

template <std::size_t N>
using Signs = std::array<std::optional<int>, N + 1>;
/// Returns the signs of the coefficients; nothing where a sign is not known. largest: the largest coordinate difference
/// of the motion (m); only used for doubles.
template <class T, std::size_t N>
Signs<N> signs_of(const Polynomial<T, N>& polynomial, double largest) {
  Signs<N> signs;
  for (std::size_t k = 0; k <= N; ++k) {
    if constexpr (std::is_same_v<T, double>) {
      double bound = max_relative_error;
      for (std::size_t degree = 0; degree < N; ++degree) bound *= largest;
      if (std::abs(polynomial.c[k]) > bound) signs[k] = polynomial.c[k] > 0 ? 1 : -1;
    } else {
      signs[k] = sign_of(polynomial.c[k]);
    }
  }
  return signs;
}
// What holds for all coefficients holds for the polynomial on the whole interval.
template <class S>
bool all_negative(const S& signs) {
  return std::all_of(signs.begin(), signs.end(), [](const auto& sign) { return sign && *sign < 0; });
}
template <class S>
bool none_negative(const S& signs) {
  return std::all_of(signs.begin(), signs.end(), [](const auto& sign) { return sign && *sign >= 0; });
}
template <class S>
bool all_known(const S& signs) {
  return std::all_of(signs.begin(), signs.end(), [](const auto& sign) { return sign.has_value(); });
}
template <class S>
int sign_changes(const S& signs) {
  int count = 0;
  for (std::size_t k = 1; k < signs.size(); ++k) count += (*signs[k] < 0) != (*signs[k - 1] < 0);
  return count;
}

double as_double(double x) { return x; }
double as_double(const Bounded& x) { return x.value; }
double as_double(const Rational& x) { return x.get_d(); }

/// Returns the root of a cubic with a single sign change. Rounded; it is only reported and decides nothing.
template <class T>
double root_of(const Polynomial<T, 3>& cubic) {
  std::array<double, 4> c;
  for (std::size_t k = 0; k < 4; ++k) c[k] = as_double(cubic.c[k]);
  const bool falling = c[0] >= 0;
  double lo = 0, hi = 1;
  for (int i = 0; i < 40; ++i) {
    const double t = (lo + hi) / 2, s = 1 - t;
    const double value = ((c[3] * t + c[2] * s) * t + c[1] * s * s) * t + c[0] * s * s * s;
    ((value >= 0) == falling ? lo : hi) = t;
  }
  return (lo + hi) / 2;
}

/// Returns true if the boxes around the two features are separate along an axis throughout the motion.
template <class Kind, class T>
bool boxes_are_separate(const FeatureMotion<T>& motion, double largest) {
  const auto& between = Kind::between(motion);
  const auto on_one_side = [&](auto component) {
    const std::optional<int> side = signs_of(between[0].*component, largest)[0];
    return side && *side != 0 && std::all_of(between.begin(), between.end(), [&](const Vector<T, 1>& v) {
             return signs_of(v.*component, largest) == Signs<1>{side, side};
           });
  };
  return on_one_side(&Vector<T, 1>::x) || on_one_side(&Vector<T, 1>::y) || on_one_side(&Vector<T, 1>::z);
}

enum class Answer { none, passage, unknown };
struct SearchResult {
  Answer answer;
  Passage passage{};
};

/// Returns the first or the second half of a motion.
template <class T>
FeatureMotion<T> half_of(FeatureMotion<T> motion, bool second) {
  for (Vector<T, 1>& v : motion) {
    for (Polynomial<T, 1>* component : {&v.x, &v.y, &v.z}) {
      component->c[second ? 0 : 1] = T((component->c[0] + component->c[1]) * T(0.5));
    }
  }
  return motion;
}

/// Finds the first passage between the times begin and begin + length.
template <class Kind, class T>
SearchResult search(const FeatureMotion<T>& motion, double largest, double begin, double length, int halvings) {
  if (boxes_are_separate<Kind>(motion, largest)) return {Answer::none};
  const Polynomial<T, 3> cubic = Kind::side(motion);
  const auto side = signs_of(cubic, largest);
  if (none_negative(side) || all_negative(side)) return {Answer::none};
  bool within = true;  // no weight is ever negative
  bool known = all_known(side);
  for (const Weight<T>& weight : Kind::weights(motion)) {
    const auto signs = signs_of(weight, largest);
    if (all_negative(signs)) return {Answer::none};
    within = within && none_negative(signs);
    known = known && all_known(signs);
  }
  if (!all_known(side)) return {Answer::unknown};
  if (sign_changes(side) == 1 && within) {
    return {Answer::passage, {begin + length * root_of(cubic), *side[0] >= 0}};
  }
  if (halvings == max_halvings) {
    if (!known) return {Answer::unknown};
    return {Answer::passage, {begin + length / 2, *side[0] >= 0}};
  }
  const SearchResult first = search<Kind>(half_of(motion, false), largest, begin, length / 2, halvings + 1);
  if (first.answer != Answer::none) return first;
  return search<Kind>(half_of(motion, true), largest, begin + length / 2, length / 2, halvings + 1);
}

/// Returns the largest coordinate difference.
double largest_of(const FeatureMotion<double>& motion) {
  double largest = 0;
  for (const Vector<double, 1>& v : motion) {
    for (const Polynomial<double, 1>* component : {&v.x, &v.y, &v.z}) {
      for (const double c : component->c) largest = std::max(largest, std::abs(c));
    }
  }
  return largest;
}

[[maybe_unused]] bool is_finite(const MovingPoint& p) {
  const auto finite = [](const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
  return finite(p.from) && finite(p.to);
}

/// Tries doubles first, then doubles with error bounds, then rationals. motion(T{}) returns the motion in the type T.
template <class Kind, class MotionOf>
std::optional<Passage> first_passage(const MotionOf& motion) {
  const FeatureMotion<double> plain = motion(double{});
  const double largest = largest_of(plain);
  SearchResult found = search<Kind>(plain, largest, 0, 1, 0);
  if (found.answer == Answer::unknown) found = search<Kind>(motion(Bounded{}), largest, 0, 1, 0);
  if (found.answer == Answer::unknown) found = search<Kind>(motion(Rational{}), largest, 0, 1, 0);
  if (found.answer == Answer::none) return std::nullopt;
  return found.passage;
}

}  // namespace

std::optional<Passage> vertex_through_face(const MovingPoint& p, const MovingPoint& a, const MovingPoint& b,
                                           const MovingPoint& c) {
  assert(is_finite(p) && is_finite(a) && is_finite(b) && is_finite(c));
  return first_passage<VertexFace>([&]<class T>(const T&) {
    return FeatureMotion<T>{difference<T>(a, p), difference<T>(b, p), difference<T>(c, p)};
  });
}

std::optional<Passage> edge_through_edge(const MovingPoint& p, const MovingPoint& q, const MovingPoint& u,
                                         const MovingPoint& v) {
  assert(is_finite(p) && is_finite(q) && is_finite(u) && is_finite(v));
  return first_passage<EdgeEdge>([&]<class T>(const T&) {
    return FeatureMotion<T>{difference<T>(q, p), difference<T>(v, u), difference<T>(u, p)};
  });
}

}  // namespace collide::oracle
