#pragma once
// Whether a body lies in a solid: it started there, or the solid was moved onto it. Contact would push its particles
// out to all sides and tear it apart, or inflate it; it is eased out as a whole, see SolidContact.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "collide/core/vertex_run.h"
#include "collide/surface/surface.h"
#include "softbody/contact/solid_surface.h"

namespace softbody {

/// What is deepest inside a solid: the points centre + s sides[0] + t sides[1] with s and t from -1 to 1. A rectangle,
/// or a segment or a point where sides have no length.
struct SolidMiddle {
  glm::dvec3 centre;
  std::array<glm::dvec3, 2> sides{};
  double depth;  // m, from the surface to it
};
/// Returns the middle of a solid; a plane has none.
std::optional<SolidMiddle> middle_of(const SolidSphere& sphere);
std::optional<SolidMiddle> middle_of(const SolidPlane& plane);
std::optional<SolidMiddle> middle_of(const SolidBox& box);
std::optional<SolidMiddle> middle_of(const SolidCapsule& capsule);

/// A body where it is now.
struct PlacedBody {
  const collide::surface::Surface& surface;
  glm::dvec3 origin;      // m
  collide::VertexRun at;  // its vertices, from the origin
  double mean_edge;       // m, at rest
};

/// Contact brings particles back from this depth by themselves, as a share of the body's mean edge.
inline constexpr double shallow = 0.25;

/// Returns for each of these bodies, all of the same origin, whether it overlaps another one: a vertex of one of the
/// two lies deeper than that in the other one, which is closed, or the middle of its vertices lies in it.
std::vector<bool> overlapping(std::span<const PlacedBody> bodies);

/// Returns true if a solid's middle is inside a closed body or crosses the surface of any.
bool holds(const PlacedBody& body, const SolidMiddle& middle);

/// Returns true if a particle is deep in the solid, or the body holds the solid's middle. between: contact keeps the
/// solid out of the faces between the particles, too; else they may hold one that is thinner than they are wide.
template <class Solid>
bool overlap(const PlacedBody& body, const Solid& solid, bool between) {
  for (collide::Index i = 0; i < body.at.size; ++i) {
    const glm::dvec3 x(body.at[i]);
    if (surface_at(solid, body.origin + x).distance < -shallow * body.mean_edge) return true;
  }
  const std::optional<SolidMiddle> middle = middle_of(solid);
  return middle && (between || middle->depth > body.mean_edge) && holds(body, *middle);
}

}  // namespace softbody
