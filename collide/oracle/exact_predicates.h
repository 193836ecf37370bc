#pragma once
// Signs of determinants of float coordinates, never wrong: evaluated in double beside a bound of their own rounding
// error (running error analysis: Higham, Accuracy and Stability of Numerical Algorithms, §3.3), and where that bound
// leaves the sign open once more in rationals. Coordinates must be finite; any finite floats will do.

#include <array>

#include <glm/vec3.hpp>

namespace collide::oracle {

/// Sign of (p - a) . ((b - a) x (c - a)): +1 if p is on the side of the plane abc from which the corners are seen
/// counter-clockwise, -1 on the other, 0 if all four lie in one plane.
int side_of_plane(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& p);

/// Sign of the x, y or z component (axis 0, 1, 2) of (b - a) x (c - a).
int sign_of_normal(int axis, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// True if p is a point of the triangle, its sides and corners included. Never for a triangle without area.
bool on_triangle(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// How often a ray from p along +x leaves (+1) or enters (-1) through a triangle: 0, +1 or -1. Summed over a closed
/// mesh that p is not on, the number of times that the mesh winds around p. The ray meets no side or corner: it starts
/// at p + (0, e, e^2) for an e > 0 too small to matter (simulation of simplicity: Edelsbrunner and Mücke 1990).
int ray_crossing(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// How the segment from p to q meets a triangle.
struct SegmentCrossing {
  // 1 if it passes from the outer side of the triangle to the inner one, -1 for the other way, 0 if it does not pass:
  // with p moved by (e, e^2, e^3), and by as much the other way. Unequal only where a side or a corner is met.
  int plus = 0, minus = 0;
  std::array<bool, 3> meets{};  // the lines through ab, bc and ca; if it passes either way
};
/// It passes if p and q lie strictly on both sides of the plane and the point between them in the triangle.
SegmentCrossing segment_crossing(const glm::vec3& p, const glm::vec3& q, const glm::vec3& a, const glm::vec3& b,
                                 const glm::vec3& c);

}  // namespace collide::oracle
