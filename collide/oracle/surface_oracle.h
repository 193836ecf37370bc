#pragma once
// The judge of all contact: what really sinks in, sticks through or passed through, found on the bodies' surfaces and
// not on their vertices' distances. Shares no code with the detectors. All answers but lengths and points are exact:
// they are signs of determinants of the float positions, rounded nowhere (collide/oracle/exact_predicates.h).
//
//   const Overlaps now = find_overlaps(frame, surfaces, workers);
//   const std::vector<Crossing> crossings = find_crossings(before, frame, surfaces, workers);
//   const SurfaceFigures figures = figures_of(frame, now, crossings);
//   const Missed missed = missed_by(detection.contacts, frame, surfaces, now);
//
// Touching is not penetrating: a vertex exactly on a surface is not inside; an edge that ends on a face, lies in its
// plane, or grazes a ridge or a rim does not pass through. Faces without area are never passed through and hold no
// inside. Two bodies whose every meeting of an edge and a face is such a touch (boxes that overlap with all their faces
// in common planes) are therefore not seen to overlap.
//
// All functions: frame.bodies and surfaces hold the same bodies, with equal vertex counts, else std::invalid_argument.
// Bodies with a coordinate that is not finite are left out. Results do not depend on the number of workers.

#include <glm/vec3.hpp>

#include "collide/core/detector.h"
#include "collide/surface/surface.h"

namespace collide::oracle {

/// A vertex strictly inside a closed body that is not its own. Inside: the surface winds around it a number of times
/// other than 0, so that concave, inverted and self-overlapping bodies have an inside too.
struct Penetration {
  Index vertex;       // over the frame
  Index body;         // that it is inside of
  Index triangle;     // of that body's surface: the nearest
  double depth;       // m, > 0 unless it underflows: distance to the nearest point of the surface
  glm::dvec3 point;   // that point; rounded, as depth and normal
  glm::dvec3 normal;  // unit vector from the vertex to that point: the shortest way out
};

/// An edge that passes through a face it shares no vertex with, of another body or of its own. An edge that passes
/// exactly through a side or a corner common to several faces passes through at least one of them.
struct Piercing {
  std::array<Index, 2> edge;  // vertices over the frame, the smaller one first
  Index edge_body;
  Index triangle_body;
  Index triangle;    // of that body's surface
  glm::dvec3 point;  // rounded
};

/// All that overlaps at one instant.
struct Overlaps {
  std::vector<Penetration> penetrations;  // ascending by vertex, then body
  std::vector<Piercing> piercings;        // ascending by edge, then body and triangle
};

/// What overlaps in a frame.
Overlaps find_overlaps(const Frame& frame, const surface::Surfaces& surfaces, Workers& workers);

/// A vertex that passed through a face, or an edge through an edge, while all vertices moved along straight lines from
/// one frame to the next. Each pair once, with its first passage; between bodies and inside one, features with a common
/// vertex left out.
struct Crossing {
  enum class Kind { vertex_face, edge_edge };
  Kind kind;
  Index body, other;             // vertex_face: of the vertex, of the face; edge_edge: body <= other
  std::array<Index, 2> feature;  // of `body`, vertices over the frame: {vertex, vertex}, or the ends of the edge
  std::array<Index, 3> against;  // of `other`, vertices over the frame: the face, or {end, end, end} of the edge
  double time;                   // 0 .. 1: of the first passage
  bool inward;                   // vertex_face: from the face's outer side to its inner side
};

/// What passed through what between the frames, which hold the same bodies. Never misses a passage. A vertex in a
/// face's plane counts as outside it, so that a passage over several frames is counted once, in the frame in which the
/// vertex leaves the plane inwards or reaches it outwards; motion within a plane passes through nothing. On the safe
/// side: a passage through a face's very rim is counted, and so is one that misses by less than moves in 2^-32 of the
/// step, or at whose time the face, or one of the edges, shrinks to nothing.
std::vector<Crossing> find_crossings(const Frame& before, const Frame& after, const surface::Surfaces& surfaces,
                                     Workers& workers);

/// Figures for a table or a panel.
struct SurfaceFigures {
  std::size_t penetrating_vertices = 0;      // each once, in however many bodies it is
  std::size_t overlapping_pairs = 0;         // pairs of bodies with a penetration or a piercing
  std::size_t self_intersecting_bodies = 0;  // bodies that pierce themselves
  double deepest = 0, mean_depth = 0;        // m, over the penetrations; 0 if there are none
  std::size_t piercings = 0;
  std::size_t crossed_vertices = 0;  // vertices that passed through a face, each once
  std::size_t edge_crossings = 0;    // pairs of edges that passed through each other
  std::size_t crossed_pairs = 0;     // pairs of different bodies with a crossing of either kind
  bool operator==(const SurfaceFigures&) const = default;
};
SurfaceFigures figures_of(const Frame& frame, const Overlaps& overlaps, std::span<const Crossing> crossings = {});

struct OverlappingPair {
  Index a, b;  // bodies, a <= b; equal: the body pierces itself
  auto operator<=>(const OverlappingPair&) const = default;
};

/// What a detector's contacts do not show of the overlaps ("missed surface contacts").
struct Missed {
  std::vector<std::size_t> penetrations;  // into Overlaps: no contact joins the vertex to a vertex of that body
  std::vector<std::size_t> piercings;     // into Overlaps: no contact joins an end of the edge to a corner of the face
  std::vector<OverlappingPair> pairs;     // ascending: no contact at all between these bodies, or inside this one
};
/// contacts: ascending, as in Result.
Missed missed_by(std::span<const Contact> contacts, const Frame& frame, const surface::Surfaces& surfaces,
                 const Overlaps& overlaps);

/// The pairs of bodies that overlap; ascending.
std::vector<OverlappingPair> overlapping_pairs(const Frame& frame, const Overlaps& overlaps);

}  // namespace collide::oracle
