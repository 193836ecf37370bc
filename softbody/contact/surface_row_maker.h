#pragma once
// The rows of surface contact. A contact is a row: the relative velocity u of the two closest points, along the unit
// normal n, must not use up the gap g within the substep of h seconds,
//
//   u . n >= -(g + d/2) / h    while half of the distance d is left: nothing passes through;
//   u . n >= 0.1 (-g - d/2) / h  where it is not: pushed out at a bounded speed;
//
// The share of 0.1, both speeds and the cone of friction are those of contact/law.h.
// Impulses that bring this about act on the corners by their weights, equal and opposite along the line between the two
// points, so that linear and angular momentum stay (but for friction, which is a couple over the distance kept). The
// distance itself is held by a spring with a damper, integrated implicitly as in a soft constraint (Catto 2011): what
// rests neither sinks in nor trembles; friction takes at most mu times them from the slip (Coulomb).

#include <vector>

#include "softbody/contact/contact_row.h"
#include "softbody/contact/surface_candidates.h"

namespace softbody {

/// Makes the rows of pairs in one substep, on one thread.
class SurfaceRowMaker {
 public:
  struct Substep {
    Field<const float> x, before;  // the latter: velocities without the forces of this substep
    float h;
    float until;    // s after the candidates were found: the end of the substep
    float h_ratio;  // the length of this substep over that of the last one; 0: there was none
  };
  struct NearFace {
    collide::surface::Closest closest;
    glm::vec3 face_normal;  // not of unit length
    float distance2;
    std::uint32_t feature;
  };
  struct Scratch {
    std::vector<NearFace> near_faces;  // faces near one vertex
    collide::surface::FeatureBatch meeting;
  };
  // Of the spring that keeps the distance, against the effective mass of the contact:
  static constexpr float spring_frequency = 750;  // 1/s, angular
  static constexpr float spring_damping = 5;      // of the critical

  /// Adds rows to `rows`; all must outlive this.
  SurfaceRowMaker(SurfaceCandidates& candidates, const Substep& step, Scratch& scratch, std::vector<ContactRow>& rows)
      : candidates_(candidates), step_(step), scratch_(scratch), rows_(rows) {}

  /// Adds the rows of a pair, and notes there where they are.
  void add_rows(SurfaceCandidates::Pair& pair);

 private:
  using Pair = SurfaceCandidates::Pair;
  using Side = SurfaceCandidates::Side;
  using CachedContact = SurfaceCandidates::CachedContact;

  template <collide::surface::PairKind kind, class Visit>
  void meet(const Side& one, const Side& two, std::uint32_t begin, std::uint32_t end, const Visit& visit);
  void vertices_on_faces(Pair& pair, std::uint32_t begin, std::uint32_t end, bool vertex_of_b);
  void vertex_on_faces(Pair& pair, const Side& vertex_side, const Side& face_side, bool oriented);
  void add_interior_vertices(Pair& pair);
  void edges_on_edges(Pair& pair);
  bool stays_apart(const Pair& pair, std::uint32_t feature, float apart);
  void add_row(const Pair& pair, const ContactRow& corners, const glm::vec3& normal, float apart,
               CachedContact& cached);
  /// Returns where a vertex is at the start of the substep.
  glm::vec3 at(const Side& side, Index vertex) const {
    return read(step_.x, side.slot + vertex * side.stride) + side.offset;
  }
  /// Returns the distance (m) beyond which a pair has no contact.
  float max_distance(const Pair& pair) const { return 1.1f * pair.distance + step_.h * pair.speed; }

  SurfaceCandidates& candidates_;
  Substep step_;
  Scratch& scratch_;
  std::vector<ContactRow>& rows_;
};

}  // namespace softbody
