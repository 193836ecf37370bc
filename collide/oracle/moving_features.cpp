#include "collide/oracle/moving_features.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "collide/oracle/motion_filter.h"
#include "collide/oracle/real_roots.h"

namespace collide::oracle {

namespace {

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
    Integer integer(static_cast<double>(scaled.digits));  // exact
    if (x != 0) integer <<= static_cast<unsigned>(scaled.exponent - exponent);
    return integer;
  });
}

/// Returns a motion, or a vector of one, on a piece of its time, times 2^halvings.
template <class Motion>
Motion restricted(const Motion& motion, const TimePiece& piece) {
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
      if (!point_is_on_segment(root, {restricted(ends[0], root.piece), restricted(ends[1], root.piece)})) continue;
      const Meeting meeting = meeting_at(root);
      first = first ? Meeting{std::min(first->low, meeting.low), std::min(first->high, meeting.high)} : meeting;
      break;
    }
  }
  return first;
}

/// The signs of the side shortly before and after a root; 1 where there is no such time.
struct Sides {
  int before, after;
};
/// side: on the piece of the root.
Sides sides_around(const Root& root, const Polynomial<Integer, 3>& side) {
  const auto not_zero = [](const Integer& x) { return x != 0; };
  const auto first = std::ranges::find_if(side.c, not_zero);
  if (!root.polynomial.empty()) return {sgn(*first), sgn(*std::find_if(side.c.rbegin(), side.c.rend(), not_zero))};
  const bool is_odd = (first - side.c.begin()) % 2 != 0;
  const bool begins = root.piece.start == 0, ends = root.piece.start == Integer(1) << root.piece.halvings;
  return {begins ? 1 : sgn(*first) * (is_odd ? -1 : 1), ends ? 1 : sgn(*first)};
}

/// Returns the time of the passage that the filter found.
template <class Kind>
Meeting meeting_at(const Filtered& passing, const Points& points) {
  if (passing.halvings == most_halvings) {
    const auto time = [](std::uint64_t step) { return std::ldexp(static_cast<double>(step), -int{most_halvings}); };
    return {time(passing.start), time(passing.start + 1)};
  }
  const TimePiece piece{integer_of(passing.start), passing.halvings};
  return meeting_at(Root{piece, coefficients(Kind::side(restricted(integer_motion<Kind>(points), piece)))});
}

[[maybe_unused]] bool all_finite(const Points& points) {
  const auto finite = [](const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  return std::ranges::all_of(points, [&](const MovingPoint& p) { return finite(p.from) && finite(p.to); });
}

template <class Kind>
std::optional<Meeting> first_meeting(const Points& points) {
  assert(all_finite(points));
  const Filtered filtered = filter_motion<Kind>(points);
  if (filtered.answer == Filtered::Answer::apart) return std::nullopt;
  if (filtered.answer == Filtered::Answer::passing) return meeting_at<Kind>(filtered, points);
  const FeatureMotion<Integer> motion = integer_motion<Kind>(points);
  const Polynomial<Integer, 3> side = Kind::side(motion);
  if (is_zero(side)) return first_meeting_in_plane<Kind>(motion);
  for (const Root& root : roots_of(coefficients(side))) {
    if (meet_at<Kind>(root, restricted(motion, root.piece))) return meeting_at(root);
  }
  return std::nullopt;
}

Passage passage_at(const Meeting& meeting, bool inward) { return {(meeting.low + meeting.high) / 2, inward}; }

template <class Kind>
std::optional<Passage> first_passage(const Points& points) {
  assert(all_finite(points));
  const Filtered filtered = filter_motion<Kind>(points);
  if (filtered.answer == Filtered::Answer::apart) return std::nullopt;
  if (filtered.answer == Filtered::Answer::passing)
    return passage_at(meeting_at<Kind>(filtered, points), filtered.inward);
  const FeatureMotion<Integer> motion = integer_motion<Kind>(points);
  const Polynomial<Integer, 3> side = Kind::side(motion);
  if (is_zero(side)) return std::nullopt;
  for (const Root& root : roots_of(coefficients(side))) {
    const FeatureMotion<Integer> piece = restricted(motion, root.piece);
    const Sides sides = sides_around(root, Kind::side(piece));
    if ((sides.before < 0 || sides.after < 0) && meet_at<Kind>(root, piece))
      return passage_at(meeting_at(root), sides.before > 0);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Meeting> meeting_of(const MovingFeatures& f) {
  return f.kind == MovingFeatures::Kind::vertex_face ? first_meeting<VertexFace>(f.points)
                                                     : first_meeting<EdgeEdge>(f.points);
}

std::optional<Passage> passage_of(const MovingFeatures& f) {
  return f.kind == MovingFeatures::Kind::vertex_face ? first_passage<VertexFace>(f.points)
                                                     : first_passage<EdgeEdge>(f.points);
}

}  // namespace collide::oracle
