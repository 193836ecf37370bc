#include "collide/oracle/moving_features.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "collide/oracle/feature_motion.h"
#include "collide/oracle/real_roots.h"

namespace collide::oracle {

namespace {

using Points = std::array<MovingPoint, 4>;

/// number(x) converts a coordinate to the type T.
template <class Kind, class T, class ToNumber>
FeatureMotion<T> motion_of(const Points& points, const ToNumber& number) {
  FeatureMotion<T> motion;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    const MovingPoint &to = points[Kind::vectors[k][0]], &from = points[Kind::vectors[k][1]];
    const auto component = [&](glm::length_t axis) {
      return Polynomial<T, 1>{
          {T(number(to.from[axis]) - number(from.from[axis])), T(number(to.to[axis]) - number(from.to[axis]))}};
    };
    motion[k] = {component(0), component(1), component(2)};
  }
  return motion;
}

/// Returns f(component) of all components of all vectors of a motion.
template <class T, class Function>
FeatureMotion<T> with_each(FeatureMotion<T> motion, const Function& f) {
  for (Vector<T, 1>& v : motion) {
    for (Polynomial<T, 1>* component : {&v.x, &v.y, &v.z}) *component = f(*component);
  }
  return motion;
}

// The filter: plain doubles decide most queries.

/// Returns true if an axis separates the boxes of the two features, in the same order at both ends of the motion and
/// therefore at all times.
template <class Kind>
bool boxes_are_separate(const Points& points) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    double min[2][2] = {{inf, inf}, {inf, inf}}, max[2][2] = {{-inf, -inf}, {-inf, -inf}};  // of a feature, at a time
    for (std::size_t k = 0; k < points.size(); ++k) {
      const std::size_t feature = k < Kind::first_size ? 0 : 1;
      for (const std::size_t time : {0u, 1u}) {
        const double x = (time == 0 ? points[k].from : points[k].to)[axis];
        min[feature][time] = std::min(min[feature][time], x);
        max[feature][time] = std::max(max[feature][time], x);
      }
    }
    if (max[0][0] < min[1][0] && max[0][1] < min[1][1]) return true;
    if (max[1][0] < min[0][0] && max[1][1] < min[0][1]) return true;
  }
  return false;
}

/// The filter halves the time at most this often.
constexpr int max_halvings = 8;

/// Returns a bound of the rounding error of each coefficient of a polynomial of degree N, beside d^N, where d is the
/// largest coordinate difference. Proof: a coordinate difference is off by at most 9 * 2^-53 d after eight halvings. A
/// coefficient of a component between vertices is a sum of 3 of them, one of the side a sum of at most 18 products of
/// 3, one of a weight a sum of at most 216 products of 4. A product and its sums round at most 2, 10 and 19 times more.
/// 3 * (9 + 2) < 2^6, 18 * (27 + 10) < 2^10, 216 * (36 + 19) < 2^14; one binary place more covers products of errors,
/// and that d^N is rounded.
template <std::size_t N>
constexpr double relative_error = N == 1   ? 0x1p-46
                                  : N == 3 ? 0x1p-42
                                           : 0x1p-38;

/// Signs of the coefficients; 0 where rounding leaves it open.
template <std::size_t N>
using Signs = std::array<int, N + 1>;

template <std::size_t N>
Signs<N> signs_of(const Polynomial<double, N>& polynomial, double largest) {
  double bound = relative_error<N>;
  for (std::size_t degree = 0; degree < N; ++degree) bound *= largest;
  Signs<N> signs;
  for (std::size_t k = 0; k <= N; ++k) signs[k] = (polynomial.c[k] > bound) - (polynomial.c[k] < -bound);
  return signs;
}
// What holds for all coefficients holds for the polynomial on the whole interval.
template <std::size_t N>
bool all_are(const std::array<int, N>& signs, int sign) {
  return std::all_of(signs.begin(), signs.end(), [&](int s) { return s == sign; });
}

template <class Kind>
bool boxes_are_separate(const FeatureMotion<double>& motion, double largest) {
  const auto& between = Kind::between(motion);
  return std::ranges::any_of(std::array{&Vector<double, 1>::x, &Vector<double, 1>::y, &Vector<double, 1>::z},
                             [&](auto component) {
                               const int side = signs_of(between[0].*component, largest)[0];
                               return side != 0 && std::ranges::all_of(between, [&](const Vector<double, 1>& v) {
                                        return all_are(signs_of(v.*component, largest), side);
                                      });
                             });
}

enum class Answer {
  apart,    // the features do not meet
  passing,  // in the piece they meet for the first time, once; the side changes there, and only there
  unknown
};
struct Filtered {
  Answer answer;
  TimePiece piece{};
  bool inward{};
};

FeatureMotion<double> half_of(const FeatureMotion<double>& motion, bool second) {
  return with_each(motion, [&](Polynomial<double, 1> x) {
    x.c[second ? 0 : 1] = (x.c[0] + x.c[1]) * 0.5;
    return x;
  });
}

template <class Kind>
Filtered filter(const FeatureMotion<double>& motion, double largest, unsigned start, unsigned halvings) {
  if (boxes_are_separate<Kind>(motion, largest)) return {Answer::apart};
  const Signs<3> side = signs_of(Kind::side(motion), largest);
  if (all_are(side, 1) || all_are(side, -1)) return {Answer::apart};
  bool within = true;
  for (const Weight<double>& weight : Kind::weights(motion)) {
    const Signs<4> signs = signs_of(weight, largest);
    if (all_are(signs, -1)) return {Answer::apart};
    within = within && all_are(signs, 1);
  }
  if (std::ranges::count(side, 0) > 0) return {Answer::unknown};
  // By Descartes' rule, a single change of sign is a single root.
  const int changes = (side[0] != side[1]) + (side[1] != side[2]) + (side[2] != side[3]);
  if (within && changes == 1) return {Answer::passing, {start, halvings}, side[0] > 0};
  if (halvings == max_halvings) return {Answer::unknown};
  const Filtered first = filter<Kind>(half_of(motion, false), largest, 2 * start, halvings + 1);
  if (first.answer != Answer::apart) return first;
  return filter<Kind>(half_of(motion, true), largest, 2 * start + 1, halvings + 1);
}

template <class Kind>
Filtered filter(const Points& points) {
  if (boxes_are_separate<Kind>(points)) return {Answer::apart};
  const FeatureMotion<double> motion = motion_of<Kind, double>(points, [](double x) { return x; });
  double largest = 0;
  for (const Vector<double, 1>& v : motion) {
    for (const Polynomial<double, 1>* component : {&v.x, &v.y, &v.z}) {
      for (const double c : component->c) largest = std::max(largest, std::abs(c));
    }
  }
  // Between these, no power up to the fourth overflows, and what underflows is less than the bounds of the errors.
  if (!(0x1p-200 < largest && largest < 0x1p200)) return {Answer::unknown};
  return filter<Kind>(motion, largest, 0, 0);
}

// The decision in integers.

/// A finite double as a product of an odd integer, or 0, and a power of two.
struct Scaled {
  std::int64_t digits = 0;
  int exponent = 0;

  explicit Scaled(double x) {
    if (x == 0) return;
    digits = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(digits));
    digits >>= zeros;
    exponent += zeros - 53;
  }
};

/// Returns the motion times the power of two that makes all coordinates integers.
template <class Kind>
FeatureMotion<Integer> integer_motion(const Points& points) {
  int exponent = std::numeric_limits<int>::max();
  for (const MovingPoint& p : points) {
    for (const glm::dvec3& v : {p.from, p.to}) {
      for (glm::length_t axis = 0; axis < 3; ++axis) {
        if (v[axis] != 0) exponent = std::min(exponent, Scaled(v[axis]).exponent);
      }
    }
  }
  return motion_of<Kind, Integer>(points, [&](double x) {
    const Scaled scaled(x);
    Integer integer = static_cast<long>(scaled.digits);
    if (x != 0) integer <<= static_cast<unsigned>(scaled.exponent - exponent);
    return integer;
  });
}

FeatureMotion<Integer> restricted(const FeatureMotion<Integer>& motion, const TimePiece& piece) {
  const Integer whole = Integer(1) << piece.halvings, end = piece.start + 1;
  return with_each(motion, [&](const Polynomial<Integer, 1>& x) {
    const auto at = [&](const Integer& time) { return Integer(x.c[0] * (whole - time) + x.c[1] * time); };
    return Polynomial<Integer, 1>{{at(piece.start), at(end)}};
  });
}

template <std::size_t N>
Coefficients coefficients(const Polynomial<Integer, N>& polynomial) {
  return {polynomial.c.begin(), polynomial.c.end()};
}
template <std::size_t N>
bool is_zero(const Polynomial<Integer, N>& polynomial) {
  return std::ranges::all_of(polynomial.c, [](const Integer& x) { return x == 0; });
}
template <std::size_t N>
int sign_at(const Root& root, const Polynomial<Integer, N>& polynomial) {
  return sign_at(root, coefficients(polynomial));
}

bool point_is_on_segment(const Root& root, const PointSegment<Integer>& ends) {
  const Vector<Integer, 2> normal = cross(ends[0], ends[1]);
  return sign_at(root, normal.x) == 0 && sign_at(root, normal.y) == 0 && sign_at(root, normal.z) == 0 &&
         sign_at(root, dot(ends[0], ends[1])) <= 0;
}

/// Returns true if the features meet at the root of a polynomial. motion: on the piece of the root. Precondition: all
/// points lie in one plane at that time.
template <class Kind>
bool meet_at(const Root& root, const FeatureMotion<Integer>& motion) {
  bool spans_plane = false;
  for (const Weight<Integer>& weight : Kind::weights(motion)) {
    const int sign = sign_at(root, weight);
    if (sign < 0) return false;
    spans_plane = spans_plane || sign > 0;
  }
  // A face without area is the union of its sides. Parallel edges can only meet where an end is on the other edge.
  return spans_plane || std::ranges::any_of(Kind::ends(motion), [&](const PointSegment<Integer>& ends) {
           return point_is_on_segment(root, ends);
         });
}

Meeting meeting_at(const Root& root) {
  const auto [low, high] = enclosure_of(root);
  return {low, high};
}

/// Returns the first meeting of features whose points always lie in one common plane. If they do not meet at once, they
/// meet for the first time at the border: a vertex on a side of the face, or an end on an edge. For where a vertex is
/// inside a face, or two edges cross inside both, they do so shortly before, too.
template <class Kind>
std::optional<Meeting> first_meeting_in_plane(const FeatureMotion<Integer>& motion) {
  if (meet_at<Kind>({}, motion)) return Meeting{0, 0};
  std::optional<Meeting> first;
  for (const PointSegment<Integer>& ends : Kind::ends(motion)) {
    const Vector<Integer, 2> normal = cross(ends[0], ends[1]);
    const auto& in_line = !is_zero(normal.x) ? normal.x : !is_zero(normal.y) ? normal.y : normal.z;
    for (const Root& root : roots_of(coefficients(is_zero(in_line) ? dot(ends[0], ends[1]) : in_line))) {
      const auto on_piece = [&](const Vector<Integer, 1>& v) { return restricted({v}, root.piece)[0]; };
      if (!point_is_on_segment(root, {on_piece(ends[0]), on_piece(ends[1])})) continue;
      const Meeting meeting = meeting_at(root);
      first = first ? Meeting{std::min(first->low, meeting.low), std::min(first->high, meeting.high)} : meeting;
      break;
    }
  }
  return first;
}

template <class Kind>
std::optional<Meeting> first_meeting(const Points& points) {
  const Filtered filtered = filter<Kind>(points);
  if (filtered.answer == Answer::apart) return std::nullopt;
  const FeatureMotion<Integer> motion = integer_motion<Kind>(points);
  if (filtered.answer == Answer::passing) {
    return meeting_at({filtered.piece, coefficients(Kind::side(restricted(motion, filtered.piece)))});
  }
  const Polynomial<Integer, 3> side = Kind::side(motion);
  if (is_zero(side)) return first_meeting_in_plane<Kind>(motion);
  for (const Root& root : roots_of(coefficients(side))) {
    if (meet_at<Kind>(root, restricted(motion, root.piece))) return meeting_at(root);
  }
  return std::nullopt;
}

/// The signs of the side shortly before and after a root; 1 where there is no such time.
struct Sides {
  int before, after;
};
Sides sides_around(const Root& root, const Polynomial<Integer, 3>& side) {
  const auto not_zero = [](const Integer& x) { return x != 0; };
  const auto first = std::ranges::find_if(side.c, not_zero);
  if (!root.polynomial.empty()) return {sgn(*first), sgn(*std::find_if(side.c.rbegin(), side.c.rend(), not_zero))};
  const bool is_odd = (first - side.c.begin()) % 2 != 0;
  const bool begins = root.piece.start == 0, ends = root.piece.start == Integer(1) << root.piece.halvings;
  return {begins ? 1 : sgn(*first) * (is_odd ? -1 : 1), ends ? 1 : sgn(*first)};
}

template <class Kind>
std::optional<Passage> first_passage(const Points& points) {
  const auto middle = [](const Meeting& meeting) { return (meeting.low + meeting.high) / 2; };
  const Filtered filtered = filter<Kind>(points);
  if (filtered.answer == Answer::apart) return std::nullopt;
  const FeatureMotion<Integer> motion = integer_motion<Kind>(points);
  if (filtered.answer == Answer::passing) {
    const Root root{filtered.piece, coefficients(Kind::side(restricted(motion, filtered.piece)))};
    return Passage{middle(meeting_at(root)), filtered.inward};
  }
  const Polynomial<Integer, 3> side = Kind::side(motion);
  if (is_zero(side)) return std::nullopt;
  for (const Root& root : roots_of(coefficients(side))) {
    const FeatureMotion<Integer> piece = restricted(motion, root.piece);
    const Sides sides = sides_around(root, Kind::side(piece));
    if ((sides.before < 0 || sides.after < 0) && meet_at<Kind>(root, piece)) {
      return Passage{middle(meeting_at(root)), sides.before > 0};
    }
  }
  return std::nullopt;
}

[[maybe_unused]] bool is_finite(const MovingPoint& p) {
  const auto finite = [](const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  return finite(p.from) && finite(p.to);
}

}  // namespace

std::optional<Meeting> vertex_meets_face(const MovingPoint& p, const MovingPoint& a, const MovingPoint& b,
                                         const MovingPoint& c) {
  assert(is_finite(p) && is_finite(a) && is_finite(b) && is_finite(c));
  return first_meeting<VertexFace>({p, a, b, c});
}

std::optional<Meeting> edge_meets_edge(const MovingPoint& p, const MovingPoint& q, const MovingPoint& u,
                                       const MovingPoint& v) {
  assert(is_finite(p) && is_finite(q) && is_finite(u) && is_finite(v));
  return first_meeting<EdgeEdge>({p, q, u, v});
}

std::optional<Passage> vertex_through_face(const MovingPoint& p, const MovingPoint& a, const MovingPoint& b,
                                           const MovingPoint& c) {
  assert(is_finite(p) && is_finite(a) && is_finite(b) && is_finite(c));
  return first_passage<VertexFace>({p, a, b, c});
}

std::optional<Passage> edge_through_edge(const MovingPoint& p, const MovingPoint& q, const MovingPoint& u,
                                         const MovingPoint& v) {
  assert(is_finite(p) && is_finite(q) && is_finite(u) && is_finite(v));
  return first_passage<EdgeEdge>({p, q, u, v});
}

}  // namespace collide::oracle
