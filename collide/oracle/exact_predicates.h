#pragma once
// Exact geometric predicates: signs of determinants of float coordinates, which are never wrong. A determinant is
// evaluated in double together with a bound of its rounding error (running error analysis: Higham, Accuracy and
// Stability of Numerical Algorithms, §3.3). Only if that bound leaves the sign open, it is evaluated again in
// rationals. Coordinates may be any finite floats.

#include <array>

#include <glm/vec3.hpp>

namespace collide::oracle {

/// Orientation test: returns the sign of (p - a) . ((b - a) x (c - a)). It is +1 on the side of the plane abc from
/// which the corners appear counter-clockwise, -1 on the other side, and 0 if all four points lie in one plane.
int side_of_plane(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& p);

/// Returns the sign of the x, y or z component (axis 0, 1, 2) of (b - a) x (c - a).
int sign_of_normal(int axis, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Returns true if p lies on the triangle, sides and corners included; false for every p if the triangle has no area.
bool on_triangle(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Returns +1 if a ray from p along +x leaves through the triangle, -1 if it enters through it, else 0. The sum over a
/// closed mesh is the winding number of the mesh around p, if p is not on the mesh. The ray never meets a side or a
/// corner: it starts at p + (0, e, e^2) for an infinitely small e > 0 (simulation of simplicity: Edelsbrunner and
/// Mücke 1990).
int ray_crossing(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// How a segment pq crosses a triangle: 1 if it passes from the outer to the inner side, -1 if it passes the other way,
/// 0 if it does not pass.
struct SegmentCrossing {
  int plus = 0, minus = 0;      // with p moved by +(e, e^2, e^3), and by -(e, e^2, e^3), for an infinitely small e > 0;
                                // they differ only if the segment meets a side or a corner
  std::array<bool, 3> meets{};  // whether it meets the lines ab, bc and ca; false unless p and q lie strictly on
                                // different sides of the plane
};
/// Returns the crossing. The segment passes if p and q lie strictly on different sides of the plane, and it meets the
/// plane inside the triangle.
SegmentCrossing segment_crossing(const glm::vec3& p, const glm::vec3& q, const glm::vec3& a, const glm::vec3& b,
                                 const glm::vec3& c);

}  // namespace collide::oracle
