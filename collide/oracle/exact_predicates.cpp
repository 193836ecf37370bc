#include "collide/oracle/exact_predicates.h"

#include "collide/oracle/exact_arithmetic.h"

namespace collide::oracle {

namespace {

template <class T>
Vector<T, 0> difference(const glm::vec3& a, const glm::vec3& b) {
  return {{{T(T(a.x) - T(b.x))}}, {{T(T(a.y) - T(b.y))}}, {{T(T(a.z) - T(b.z))}}};
}

/// Returns the sign of a number. compute(T{}) computes it in the type T.
template <class Compute>
int exact_sign(const Compute& compute) {
  if (const std::optional<int> sign = sign_of(compute(Bounded{}))) return *sign;
  return *sign_of(compute(Rational{}));
}

/// Orientation test in the plane of two axes: returns the sign of (b - a) x (c - a).
int orientation_2d(glm::length_t u, glm::length_t v, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return exact_sign([&]<class T>(const T&) {
    const T bu = T(b[u]) - T(a[u]), bv = T(b[v]) - T(a[v]), cu = T(c[u]) - T(a[u]), cv = T(c[v]) - T(a[v]);
    return T(bu * cv - bv * cu);
  });
}

int sign_of_difference(float a, float b) { return (a > b) - (a < b); }

/// The side on which the line pq passes the line uv. If the lines meet, it depends on how p is moved: by +(e, e^2,
/// e^3), the side is the sign of the first component of the normal of q, u, v that is not 0; by -(e, e^2, e^3), the
/// opposite.
struct LineSide {
  int plus, minus;
  bool meets() const { return plus != minus; }
};
LineSide line_side(const glm::vec3& p, const glm::vec3& q, const glm::vec3& u, const glm::vec3& v) {
  if (const int side = side_of_plane(q, u, v, p); side != 0) return {side, side};
  for (int axis = 0; axis < 3; ++axis) {
    if (const int side = sign_of_normal(axis, q, u, v); side != 0) return {side, -side};
  }
  return {0, 0};
}

}  // namespace

int side_of_plane(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& p) {
  return exact_sign([&]<class T>(const T&) {
    return dot(difference<T>(p, a), cross(difference<T>(b, a), difference<T>(c, a))).c[0];
  });
}

int sign_of_normal(int axis, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return orientation_2d((axis + 1) % 3, (axis + 2) % 3, a, b, c);
}

bool on_triangle(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  if (side_of_plane(a, b, c, p) != 0) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const int s = sign_of_normal(axis, a, b, c);
    if (s == 0) continue;
    return sign_of_normal(axis, p, a, b) * s >= 0 && sign_of_normal(axis, p, b, c) * s >= 0 &&
           sign_of_normal(axis, p, c, a) * s >= 0;
  }
  return false;
}

int ray_crossing(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  // The side of the line uv on which the ray is, as seen along the ray. Its start is moved in y first, then in z.
  const auto side_of_line = [&](const glm::vec3& u, const glm::vec3& v) {
    if (const int s = sign_of_normal(0, p, u, v); s != 0) return s;
    if (const int s = sign_of_difference(u.z, v.z); s != 0) return s;
    return sign_of_difference(v.y, u.y);
  };
  const int s = side_of_line(a, b);
  if (s == 0 || side_of_line(b, c) != s || side_of_line(c, a) != s) return 0;
  return side_of_plane(a, b, c, p) * s < 0 ? s : 0;
}

SegmentCrossing segment_crossing(const glm::vec3& p, const glm::vec3& q, const glm::vec3& a, const glm::vec3& b,
                                 const glm::vec3& c) {
  const int from = side_of_plane(a, b, c, p);
  if (from == 0 || side_of_plane(a, b, c, q) != -from) return {};
  const LineSide ab = line_side(p, q, a, b), bc = line_side(p, q, b, c), ca = line_side(p, q, c, a);
  return {ab.plus == bc.plus && bc.plus == ca.plus ? from : 0,
          ab.minus == bc.minus && bc.minus == ca.minus ? from : 0,
          {ab.meets(), bc.meets(), ca.meets()}};
}

}  // namespace collide::oracle
