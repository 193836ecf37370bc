#pragma once
// A vertex and a face, or two edges, in motion, as polynomials of the time in any type of numbers.

#include <array>
#include <cstddef>

#include "collide/oracle/exact_arithmetic.h"
#include "collide/oracle/moving_features.h"

namespace collide::oracle {

using Points = std::array<MovingPoint, 4>;  // p, a, b, c or p, q, u, v

/// Three difference vectors of four points, as polynomials of degree N.
template <class T, std::size_t N>
using Differences = std::array<Vector<T, N>, 3>;
/// The relative motion of four points.
template <class T>
using FeatureMotion = Differences<T, 1>;

template <class T>
using Weight = Polynomial<T, 4>;

/// A point and a segment, as the vectors from the point to the ends of the segment.
template <class T>
using PointSegment = std::array<Vector<T, 1>, 2>;

/// A vertex p and a face abc, as the vectors a - p, b - p and c - p.
struct VertexFace {
  /// The points of each vector: it leads from the second to the first.
  static constexpr std::array<std::array<int, 2>, 3> vectors{{{1, 0}, {2, 0}, {3, 0}}};
  static constexpr std::size_t first_size = 1;  // points of the first feature

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
  /// negative while the projection lies on the face. All are 0 where the face has no area.
  template <class T, std::size_t N>
  static std::array<Polynomial<T, 4 * N>, 3> weights(const Differences<T, N>& v) {
    const Vector<T, 2 *N> a = cross(v[1], v[2]), b = cross(v[2], v[0]), c = cross(v[0], v[1]);
    const Vector<T, 2 * N> normal = a + b + c;
    return {dot(normal, a), dot(normal, b), dot(normal, c)};
  }
  /// Returns the vertex with each side of the face.
  template <class T>
  static std::array<PointSegment<T>, 3> ends(const FeatureMotion<T>& v) {
    return {{{v[0], v[1]}, {v[1], v[2]}, {v[2], v[0]}}};
  }
};

/// Two edges pq and uv, as the vectors q - p, v - u and u - p.
struct EdgeEdge {
  static constexpr std::array<std::array<int, 2>, 3> vectors{{{1, 0}, {3, 2}, {2, 0}}};
  static constexpr std::size_t first_size = 2;

  template <class T>
  static std::array<Vector<T, 1>, 4> between(const FeatureMotion<T>& v) {
    return {v[2], v[2] - v[0], v[2] + v[1], v[2] + v[1] - v[0]};
  }
  template <class T>
  static Polynomial<T, 3> side(const FeatureMotion<T>& v) {
    return dot(v[2], cross(v[0], v[1]));
  }
  /// Returns s, 1 - s, r and 1 - r, where s and r are the parameters of the closest points of the two lines, times the
  /// squared length of the normal. None is negative while these points lie on the edges. All are 0 where the edges are
  /// parallel or one has no length.
  template <class T, std::size_t N>
  static std::array<Polynomial<T, 4 * N>, 4> weights(const Differences<T, N>& v) {
    const Vector<T, 2 * N> normal = cross(v[0], v[1]);
    const Polynomial<T, 4 * N> length2 = dot(normal, normal);
    const Polynomial<T, 4 *N> along_p = dot(normal, cross(v[2], v[1])), along_u = dot(normal, cross(v[2], v[0]));
    return {along_p, length2 - along_p, along_u, length2 - along_u};
  }
  /// Returns each end with the other edge.
  template <class T>
  static std::array<PointSegment<T>, 4> ends(const FeatureMotion<T>& v) {
    const auto [pu, qu, pv, qv] = between(v);
    return {{{pu, pv}, {qu, qv}, {pu, qu}, {pv, qv}}};
  }
};

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

/// Returns the motion with f(component) in place of each component of its vectors.
template <class T, class Function>
Vector<T, 1> with_each(const Vector<T, 1>& v, const Function& f) {
  return {f(v.x), f(v.y), f(v.z)};
}
template <class T, class Function>
FeatureMotion<T> with_each(const FeatureMotion<T>& motion, const Function& f) {
  return {with_each(motion[0], f), with_each(motion[1], f), with_each(motion[2], f)};
}

}  // namespace collide::oracle
