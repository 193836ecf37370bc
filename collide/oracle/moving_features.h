#pragma once
// Continuous collision detection: passages of moving features through each other while all vertices move along straight
// lines. The test is that of Provot (1997): the four vertices lie in one plane at the roots of a cubic. But no root is
// computed for the decision. Instead, time is halved until the boxes around the features are separate, or until the
// signs of Bernstein coefficients prove that there is no passage, or exactly one. The signs are exact, see
// exact_arithmetic.h.

#include <optional>

#include <glm/vec3.hpp>

namespace collide::oracle {

struct MovingPoint {
  glm::vec3 from, to;  // m, at the times 0 and 1
};

struct Passage {
  double time;  // 0 .. 1
  bool inward;  // the side changes from positive to negative
};

/// The step is halved at most this often. Where no passage can be excluded then, one is reported.
inline constexpr int max_halvings = 32;

/// Returns the first passage of a vertex p through a face abc, sides and corners included. The side of p is positive if
/// the corners appear counter-clockwise from p or p lies in their plane, else negative. A passage is a change of side.
/// Precondition: all coordinates are finite.
std::optional<Passage> vertex_through_face(const MovingPoint& p, const MovingPoint& a, const MovingPoint& b,
                                           const MovingPoint& c);

/// Returns the first passage of an edge pq through an edge uv, ends included. The side is the sign of
/// (u - p) . ((q - p) x (v - u)), where 0 counts as positive. A passage is a change of side. Precondition: all
/// coordinates are finite.
std::optional<Passage> edge_through_edge(const MovingPoint& p, const MovingPoint& q, const MovingPoint& u,
                                         const MovingPoint& v);

}  // namespace collide::oracle
