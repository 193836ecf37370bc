#pragma once
// Passages of moving features through each other while all vertices move along straight lines: the continuous test of
// Provot (1997), in which the four vertices lie in one plane at the roots of a cubic, with no root ever computed for
// the decision. Time is halved instead until the boxes around the features are apart or signs of Bernstein
// coefficients, exact by collide/oracle/exact_arithmetic.h, tell that there is no passage, or just one.

#include <optional>

#include <glm/vec3.hpp>

namespace collide::oracle {

struct MovingPoint {
  glm::vec3 from, to;  // at the times 0 and 1; finite
};

struct Passage {
  double time;  // 0 .. 1
  bool inward;  // the side changes from positive to negative
};

/// After so many halvings of the step what still cannot be told from a passage is called one.
inline constexpr int max_halvings = 32;

/// First passage of p through the triangle abc, its rim included. The side of p is positive or 0 where the corners are
/// seen counter-clockwise or p is in their plane, else negative; only a change of side is a passage.
std::optional<Passage> vertex_through_face(const MovingPoint& p, const MovingPoint& a, const MovingPoint& b,
                                           const MovingPoint& c);

/// First passage of the edge pq through the edge uv, their ends included. The side is the sign of
/// (u - p) . ((q - p) x (v - u)), 0 counting as positive; only a change of it is a passage.
std::optional<Passage> edge_through_edge(const MovingPoint& p, const MovingPoint& q, const MovingPoint& u,
                                         const MovingPoint& v);

}  // namespace collide::oracle
