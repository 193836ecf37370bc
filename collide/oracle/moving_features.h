#pragma once
// Continuous collision detection: what two features do while all vertices move along straight lines, a vertex and a
// face or an edge and an edge. Two questions: do they *meet*, that is, do they share a point at some time; and do they
// *pass* through each other, that is, does the side change while they share a point. Every answer is exact, whatever
// the coordinates: edges may have no length and faces no area, all points may stay in one plane, features may rest,
// slide, or touch at the first or the last instant only. README.md has the proof in short.

#include <optional>

#include <glm/vec3.hpp>

namespace collide::oracle {

struct MovingPoint {
  glm::dvec3 from, to;  // m, at the times 0 and 1
};

/// The first time at which two features meet lies between these times, which are at most 1e-12 apart.
struct Meeting {
  double low, high;  // 0 .. 1
};

/// Returns the first meeting of a vertex p with a face abc, sides and corners included. Precondition of all four
/// functions: all coordinates are finite.
std::optional<Meeting> vertex_meets_face(const MovingPoint& p, const MovingPoint& a, const MovingPoint& b,
                                         const MovingPoint& c);

/// Returns the first meeting of an edge pq with an edge uv, ends included.
std::optional<Meeting> edge_meets_edge(const MovingPoint& p, const MovingPoint& q, const MovingPoint& u,
                                       const MovingPoint& v);

struct Passage {
  double time;  // 0 .. 1; rounded
  bool inward;  // the side changes from positive to negative
};

/// Returns the first passage of a vertex p through a face abc, sides and corners included. The side of p is positive if
/// the corners appear counter-clockwise from p or p lies in their plane, else negative. A passage is a change of side
/// at a time at which the features meet.
std::optional<Passage> vertex_through_face(const MovingPoint& p, const MovingPoint& a, const MovingPoint& b,
                                           const MovingPoint& c);

/// Returns the first passage of an edge pq through an edge uv, ends included. The side is the sign of
/// (u - p) . ((q - p) x (v - u)), where 0 counts as positive.
std::optional<Passage> edge_through_edge(const MovingPoint& p, const MovingPoint& q, const MovingPoint& u,
                                         const MovingPoint& v);

}  // namespace collide::oracle
