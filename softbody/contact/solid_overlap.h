#pragma once
// Whether a body lies in a solid: it started there, or the solid was moved onto it. Contact would push its particles
// out to all sides and tear it apart, or inflate it; it is eased out as a whole, see SolidContact.

#include <span>
#include <vector>

#include "collide/core/vertex_run.h"
#include "collide/surface/surface.h"
#include "softbody/contact/solid_surface.h"

namespace softbody {

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

/// Returns true if a particle is deep in the solid, or the solid's middle is inside the body, if this is closed, or
/// crosses its surface. between: contact keeps the solid out of the faces between the particles, too; else they may
/// hold one that is thinner than they are wide.
bool overlap(const PlacedBody& body, const Solid& solid, bool between);

}  // namespace softbody
