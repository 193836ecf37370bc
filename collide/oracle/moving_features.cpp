#include "collide/oracle/moving_features.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "collide/oracle/exact_arithmetic.h"

namespace collide::oracle {

namespace {

/// Three difference vectors of four points say all about how these lie to each other.
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

/// A vertex p against a face abc, by a - p, b - p, c - p.
struct VertexFace {
  /// From every point of the one feature to every point that spans the other.
  template <class T>
  static const FeatureMotion<T>& between(const FeatureMotion<T>& v) {
    return v;
  }
  template <class T>
  static Polynomial<T, 3> side(const FeatureMotion<T>& v) {
    return dot(v[0], cross(v[2], v[1]));
  }
  /// In the plane of the face: the barycentric coordinates of p times the squared length of the normal.
  template <class T>
  static std::array<Weight<T>, 3> weights(const FeatureMotion<T>& v) {
    const Vector<T, 2> a = cross(v[1], v[2]), b = cross(v[2], v[0]), c = cross(v[0], v[1]);
    const Vector<T, 2> normal = a + b + c;
    return {dot(normal, a), dot(normal, b), dot(normal, c)};
  }
};

/// An edge pq against an edge uv, by q - p, v - u, u - p.
struct EdgeEdge {
  template <class T>
  static std::array<Vector<T, 1>, 4> between(const FeatureMotion<T>& v) {
    return {v[2], v[2] - v[0], v[2] + v[1], v[2] + v[1] - v[0]};
  }
  template <class T>
  static Polynomial<T, 3> side(const FeatureMotion<T>& v) {
    return dot(v[2], cross(v[0], v[1]));
  }
  /// In one plane: how far along each edge their lines meet, and how far that is from its other end, times the squared
  /// length of the normal.
  template <class T>
  static std::array<Weight<T>, 4> weights(const FeatureMotion<T>& v) {
    const Vector<T, 2> normal = cross(v[0], v[1]);
    const Weight<T> whole = dot(normal, normal);
    const Weight<T> along_p = dot(normal, cross(v[2], v[1])), along_u = dot(normal, cross(v[2], v[0]));
    return {along_p, whole - along_p, along_u, whole - along_u};
  }
};

/// Most signs are clear from plain doubles already: their rounding, in all that is computed here, is less than this
/// part of the largest coordinate difference to the power of the polynomial's degree. (No coefficient sums more than
/// 432 products of at most four factors, with no more than 160 roundings in each, 128 of them of halvings: 432 * 160 *
/// 2^-53 is less than 2^-36.)
constexpr double largest_rounding = 0x1p-35;

template <std::size_t N>
using Signs = std::array<std::optional<int>, N + 1>;
/// largest: coordinate difference of the motion, in m; for doubles only.
template <class T, std::size_t N>
Signs<N> signs_of(const Polynomial<T, N>& polynomial, double largest) {
  Signs<N> signs;
  for (std::size_t k = 0; k <= N; ++k) {
    if constexpr (std::is_same_v<T, double>) {
      double bound = largest_rounding;
      for (std::size_t degree = 0; degree < N; ++degree) bound *= largest;
      if (std::abs(polynomial.c[k]) > bound) signs[k] = polynomial.c[k] > 0 ? 1 : -1;
    } else {
      signs[k] = sign_of(polynomial.c[k]);
    }
  }
  return signs;
}
// Of all coefficients, hence of the polynomial on the whole interval.
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
int changes(const S& signs) {
  int count = 0;
  for (std::size_t k = 1; k < signs.size(); ++k) count += (*signs[k] < 0) != (*signs[k - 1] < 0);
  return count;
}

double as_double(double x) { return x; }
double as_double(const Bounded& x) { return x.value; }
double as_double(const Rational& x) { return x.get_d(); }

/// Where a cubic with a single change of sign changes it. For information: not exact.
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

/// True if the boxes around the two features never meet.
template <class Kind, class T>
bool apart(const FeatureMotion<T>& motion, double largest) {
  const auto& between = Kind::between(motion);
  const auto on_one_side = [&](auto component) {
    const std::optional<int> side = signs_of(between[0].*component, largest)[0];
    return side && *side != 0 && std::all_of(between.begin(), between.end(), [&](const Vector<T, 1>& v) {
             return signs_of(v.*component, largest) == Signs<1>{side, side};
           });
  };
  return on_one_side(&Vector<T, 1>::x) || on_one_side(&Vector<T, 1>::y) || on_one_side(&Vector<T, 1>::z);
}

enum class Answer { none, passage, unsure };
struct Found {
  Answer answer;
  Passage passage{};
};

/// The first or the second half of a motion.
template <class T>
FeatureMotion<T> half_of(FeatureMotion<T> motion, bool second) {
  for (Vector<T, 1>& v : motion) {
    for (Polynomial<T, 1>* component : {&v.x, &v.y, &v.z}) {
      component->c[second ? 0 : 1] = T((component->c[0] + component->c[1]) * T(0.5));
    }
  }
  return motion;
}

/// The first passage between the times begin and begin + length.
template <class Kind, class T>
Found search(const FeatureMotion<T>& motion, double largest, double begin, double length, int halvings) {
  if (apart<Kind>(motion, largest)) return {Answer::none};
  const Polynomial<T, 3> cubic = Kind::side(motion);
  const auto side = signs_of(cubic, largest);
  if (none_negative(side) || all_negative(side)) return {Answer::none};
  bool meet = true;  // throughout
  bool known = all_known(side);
  for (const Weight<T>& weight : Kind::weights(motion)) {
    const auto signs = signs_of(weight, largest);
    if (all_negative(signs)) return {Answer::none};
    meet = meet && none_negative(signs);
    known = known && all_known(signs);
  }
  if (!all_known(side)) return {Answer::unsure};
  if (changes(side) == 1 && meet) {
    return {Answer::passage, {begin + length * root_of(cubic), *side[0] >= 0}};
  }
  if (halvings == max_halvings) {
    if (!known) return {Answer::unsure};
    return {Answer::passage, {begin + length / 2, *side[0] >= 0}};
  }
  const Found first = search<Kind>(half_of(motion, false), largest, begin, length / 2, halvings + 1);
  if (first.answer != Answer::none) return first;
  return search<Kind>(half_of(motion, true), largest, begin + length / 2, length / 2, halvings + 1);
}

double largest_of(const FeatureMotion<double>& motion) {
  double largest = 0;
  for (const Vector<double, 1>& v : motion) {
    for (const Polynomial<double, 1>* component : {&v.x, &v.y, &v.z}) {
      for (const double c : component->c) largest = std::max(largest, std::abs(c));
    }
  }
  return largest;
}

/// motion: a function of a number's type, called with T{}.
template <class Kind, class Make>
std::optional<Passage> first_passage(const Make& motion) {
  const FeatureMotion<double> plain = motion(double{});
  const double largest = largest_of(plain);
  Found found = search<Kind>(plain, largest, 0, 1, 0);
  if (found.answer == Answer::unsure) found = search<Kind>(motion(Bounded{}), largest, 0, 1, 0);
  if (found.answer == Answer::unsure) found = search<Kind>(motion(Rational{}), largest, 0, 1, 0);
  if (found.answer == Answer::none) return std::nullopt;
  return found.passage;
}

}  // namespace

std::optional<Passage> vertex_through_face(const MovingPoint& p, const MovingPoint& a, const MovingPoint& b,
                                           const MovingPoint& c) {
  return first_passage<VertexFace>([&]<class T>(const T&) {
    return FeatureMotion<T>{difference<T>(a, p), difference<T>(b, p), difference<T>(c, p)};
  });
}

std::optional<Passage> edge_through_edge(const MovingPoint& p, const MovingPoint& q, const MovingPoint& u,
                                         const MovingPoint& v) {
  return first_passage<EdgeEdge>([&]<class T>(const T&) {
    return FeatureMotion<T>{difference<T>(q, p), difference<T>(v, u), difference<T>(u, p)};
  });
}

}  // namespace collide::oracle
