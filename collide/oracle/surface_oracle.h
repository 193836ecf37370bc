#pragma once
// The reference for all contact: which vertices are inside other bodies, which edges stick through faces, and what
// passed through what between two frames. It looks at the surfaces of the bodies, not at distances of vertices, and
// shares no code with the detectors. All results except lengths and points are exact: they are signs of determinants of
// the float positions, without any rounding (exact_predicates.h).
//
//   const Overlaps now = find_overlaps(frame, surfaces, workers);
//   const std::vector<Crossing> crossings = find_crossings(before, frame, surfaces, workers);
//   const SurfaceFigures figures = figures_of(frame, now, crossings);
//   const Missed missed = missed_by(detection.contacts, frame, surfaces, now);
//
// Touching is not penetrating. A vertex exactly on a surface is not inside. An edge does not pass through a face if it
// ends on it, lies in its plane, or only grazes a ridge or a border. No edge passes through a face without area, and
// such a face encloses no inside. Therefore, two bodies that meet only in this way are not reported to overlap: for
// example, boxes whose faces all lie in common planes.
//
// Preconditions of all functions: surfaces has one entry for each body of the frame, null or with as many vertices as
// the body, else they throw std::invalid_argument. Bodies with a coordinate that is not finite are left out. Results do
// not depend on the number of workers.

#include <glm/vec3.hpp>

#include "collide/core/detector.h"
#include "collide/oracle/moving_mesh.h"

namespace collide::oracle {

/// A vertex strictly inside a closed body that is not its own. Inside means that the winding number of the surface
/// around it is not 0, so that concave, inverted and self-overlapping bodies have an inside, too.
struct Penetration {
  Index vertex;       // its number in the frame
  Index body;         // the body around it
  Index triangle;     // the nearest triangle of that body's surface
  double depth;       // m: distance to the nearest point of the surface; > 0 unless it underflows; rounded
  glm::dvec3 point;   // m: the nearest point; rounded
  glm::dvec3 normal;  // unit vector from the vertex to that point: the shortest way out; rounded
  bool operator==(const Penetration&) const = default;
};

/// An edge that passes through a face, of another body or of its own, with which it shares no vertex. If it passes
/// exactly through a common side or corner of several faces, it is reported for at least one of them.
struct Piercing {
  std::array<Index, 2> edge;  // vertices as numbers in the frame; the smaller one first
  Index edge_body;
  Index triangle_body;
  Index triangle;    // of the surface of triangle_body
  glm::dvec3 point;  // m; rounded
  bool operator==(const Piercing&) const = default;
};

/// All overlaps at one instant.
struct Overlaps {
  std::vector<Penetration> penetrations;  // ascending by vertex, then body
  std::vector<Piercing> piercings;        // ascending by edge, then body and triangle
};

/// Finds all overlaps in a frame. depths: false leaves out how deep and where penetrations are, which takes most time.
Overlaps find_overlaps(const Frame& frame, const surface::Surfaces& surfaces, Workers& workers, bool depths = true);

/// A vertex that passed through a face, or an edge that passed through an edge, while all vertices moved along straight
/// lines from one frame to the next. Each pair is listed once, with its first passage. The features belong to different
/// bodies or to one body; those with a common vertex are left out.
struct Crossing : MovingPair {  // vertices as numbers in the frame
  Index body, other;            // of `feature` and of `against`; edge_edge: body <= other
  double time;                  // 0 .. 1: of the first passage
  bool inward;                  // vertex_face: from the outer side of the face to its inner side
  bool operator==(const Crossing&) const = default;
};

/// Finds all crossings between two frames, ascending, exactly: no passage is missed, and none is reported without a
/// point that both features share when the side changes (moving_features.h). A vertex in the plane of a face counts as
/// outside, so that a passage over several frames is counted once: in the frame in which the vertex leaves the plane
/// inwards, or reaches it from the inside. Motion within a plane is no passage. A passage exactly through the border of
/// several faces is one through each of them. Throws std::invalid_argument if the frames do not have the same bodies.
std::vector<Crossing> find_crossings(const Frame& before, const Frame& after, const surface::Surfaces& surfaces,
                                     Workers& workers);

/// Numbers of overlaps and crossings, for a table or a panel.
struct SurfaceFigures {
  std::size_t penetrating_vertices = 0;      // each counted once, even if it is in several bodies
  std::size_t overlapping_pairs = 0;         // pairs of bodies with a penetration or a piercing
  std::size_t self_intersecting_bodies = 0;  // bodies that pierce themselves
  double deepest = 0, mean_depth = 0;        // m, largest and mean depth of the penetrations; 0 if there are none
  std::size_t piercings = 0;
  std::size_t crossed_vertices = 0;  // vertices that passed through a face, each counted once
  std::size_t edge_crossings = 0;    // pairs of edges that passed through each other
  bool operator==(const SurfaceFigures&) const = default;
};
/// Counts the overlaps and crossings of a frame.
SurfaceFigures figures_of(const Frame& frame, const Overlaps& overlaps, std::span<const Crossing> crossings = {});

struct OverlappingPair {
  Index a, b;  // bodies, a <= b; a == b: the body pierces itself
  auto operator<=>(const OverlappingPair&) const = default;
};

/// The overlaps that the contacts of a detector do not show ("missed surface contacts").
struct Missed {
  std::vector<std::size_t> penetrations;  // indices into Overlaps: no contact joins the vertex to a vertex of that body
  std::vector<std::size_t> piercings;  // indices into Overlaps: no contact joins an end of the edge to a corner of the
                                       // face
  std::vector<OverlappingPair> pairs;  // no contact joins the two bodies, or lies inside the one; ascending
};
/// Returns the overlaps that the contacts do not show. Precondition: the contacts are ascending, as in Result.
Missed missed_by(std::span<const Contact> contacts, const Frame& frame, const surface::Surfaces& surfaces,
                 const Overlaps& overlaps);

/// Returns the pairs of bodies that overlap; ascending.
std::vector<OverlappingPair> overlapping_pairs(const Frame& frame, const Overlaps& overlaps);

}  // namespace collide::oracle
