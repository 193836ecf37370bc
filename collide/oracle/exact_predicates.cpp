#include "collide/oracle/exact_predicates.h"

#include "collide/oracle/exact_arithmetic.h"

namespace collide::oracle {

namespace {

template <class T>
Vector<T, 0> difference(const glm::vec3& a, const glm::vec3& b) {
  return {{{T(T(a.x) - T(b.x))}}, {{T(T(a.y) - T(b.y))}}, {{T(T(a.z) - T(b.z))}}};
}

/// value: a function of a number's type, called with T{}.
template <class Value>
int exact_sign(const Value& value) {
  if (const std::optional<int> sign = sign_of(value(Bounded{}))) return *sign;
  return *sign_of(value(Rational{}));
}

/// The sign of the z component of a vector product in the plane of two axes.
int turn(glm::length_t u, glm::length_t v, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return exact_sign([&]<class T>(const T&) {
    const T bu = T(b[u]) - T(a[u]), bv = T(b[v]) - T(a[v]), cu = T(c[u]) - T(a[u]), cv = T(c[v]) - T(a[v]);
    return T(bu * cv - bv * cu);
  });
}

int sign_of_difference(float a, float b) { return (a > b) - (a < b); }

/// On which side the line from p to q passes the line from u to v. On none: where p moved by +(e, e^2, e^3) would put
/// it, the sign of the first component of the normal of q, u, v that is not 0.
struct Passing {
  int plus, minus;
  bool meets() const { return plus != minus; }
};
Passing passing(const glm::vec3& p, const glm::vec3& q, const glm::vec3& u, const glm::vec3& v) {
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
  return turn((axis + 1) % 3, (axis + 2) % 3, a, b, c);
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
  // Seen along the ray: on which side of the line from u to v the ray is; its start is moved in y first, then in z.
  const auto turn_of = [&](const glm::vec3& u, const glm::vec3& v) {
    if (const int s = sign_of_normal(0, p, u, v); s != 0) return s;
    if (const int s = sign_of_difference(u.z, v.z); s != 0) return s;
    return sign_of_difference(v.y, u.y);
  };
  const int s = turn_of(a, b);
  if (s == 0 || turn_of(b, c) != s || turn_of(c, a) != s) return 0;
  return side_of_plane(a, b, c, p) * s < 0 ? s : 0;
}

SegmentCrossing segment_crossing(const glm::vec3& p, const glm::vec3& q, const glm::vec3& a, const glm::vec3& b,
                                 const glm::vec3& c) {
  const int from = side_of_plane(a, b, c, p);
  if (from == 0 || side_of_plane(a, b, c, q) != -from) return {};
  const Passing ab = passing(p, q, a, b), bc = passing(p, q, b, c), ca = passing(p, q, c, a);
  return {ab.plus == bc.plus && bc.plus == ca.plus ? from : 0,
          ab.minus == bc.minus && bc.minus == ca.minus ? from : 0,
          {ab.meets(), bc.meets(), ca.meets()}};
}

}  // namespace collide::oracle
