#pragma once
// Continuous collision detection: what two features do while all vertices move along straight lines, a vertex and a
// face or an edge and an edge. Two questions: do they *meet*, that is, do they share a point at some time; and do they
// *pass* through each other, that is, does the side change while they share a point. Every answer is exact, whatever
// the coordinates: edges may have no length and faces no area, all points may stay in one plane, features may rest,
// slide, or touch at the first or the last instant only. README.md has the proof in short.

#include <array>
#include <optional>

#include <glm/vec3.hpp>

namespace collide::oracle {

struct MovingPoint {
  glm::dvec3 from, to;  // m, at the times 0 and 1
};

/// A vertex p and a face abc, sides and corners included, or two edges pq and uv, ends included.
struct MovingFeatures {
  enum class Kind { vertex_face, edge_edge };
  Kind kind;
  std::array<MovingPoint, 4> points;  // p, a, b, c or p, q, u, v; all coordinates must be finite
};

/// The first time at which two features meet lies between these times, which are at most 1e-12 apart.
struct Meeting {
  double low, high;  // 0 .. 1
};

/// Returns the first meeting of two features.
std::optional<Meeting> meeting_of(const MovingFeatures& features);

struct Passage {
  double time;  // 0 .. 1; rounded
  bool inward;  // the side changes from positive to negative
};

/// Returns the first passage of two features through each other: a change of side at a time at which they meet. The
/// side of p is positive if the corners abc appear counter-clockwise from p or p lies in their plane, else negative.
/// The side of two edges is the sign of (u - p) . ((q - p) x (v - u)), where 0 counts as positive.
std::optional<Passage> passage_of(const MovingFeatures& features);

}  // namespace collide::oracle
