#include "softbody/contact/solid_overlap.h"

#include <algorithm>

#include "collide/core/vertex_kernels.h"
#include "collide/surface/closed_shell.h"
#include "softbody/contact/solid_geometry.h"

namespace softbody {
namespace {

using Corners = std::array<glm::dvec3, 3>;

/// Returns six times the volume of a tetrahedron, with its sign.
double volume_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

bool crosses(const glm::dvec3& p, const glm::dvec3& q, const Corners& t) {
  if (volume_of(t[0], t[1], t[2], p) * volume_of(t[0], t[1], t[2], q) >= 0) return false;
  const double a = volume_of(p, q, t[0], t[1]), b = volume_of(p, q, t[1], t[2]), c = volume_of(p, q, t[2], t[0]);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

/// Returns true if a vertex of a body lies deep in another, closed one, or the middle of its vertices lies in it.
bool lies_in(const PlacedBody& body, const PlacedBody& other) {
  if (!other.surface.closed()) return false;
  const collide::surface::ClosedShell shell(other.surface, other.at);
  glm::vec3 middle(0.0f);
  for (collide::Index i = 0; i < body.at.size; ++i) {
    const glm::vec3 p = body.at[i];
    if (shell.inside(p) && double(shell.nearest_face(p).distance) > shallow * other.mean_edge) return true;
    middle += p / float(body.at.size);
  }
  return shell.inside(middle);
}

/// Returns true if a solid's middle is inside a closed body or crosses the surface of any.
bool holds(const PlacedBody& body, const SolidMiddle& middle) {
  const glm::dvec3 centre = middle.centre - body.origin;
  if (body.surface.closed() && collide::surface::ClosedShell(body.surface, body.at).inside(glm::vec3(centre)))
    return true;
  const auto vertex = [&](collide::Index v) { return glm::dvec3(body.at[v]); };
  const auto& [u, v] = middle.sides;
  const std::array<glm::dvec3, 4> corner{centre - u - v, centre + u - v, centre + u + v, centre - u + v};
  const auto through_face = [&](const collide::surface::Triangle& face) {
    const Corners t{vertex(face[0]), vertex(face[1]), vertex(face[2])};
    for (std::size_t k = 0; k < 4; ++k)
      if (crosses(corner[k], corner[(k + 1) % 4], t)) return true;
    return false;
  };
  const auto edge_through = [&](const collide::surface::Edge& edge) {
    const glm::dvec3 p = vertex(edge[0]), q = vertex(edge[1]);
    return crosses(p, q, {corner[0], corner[1], corner[2]}) || crosses(p, q, {corner[0], corner[2], corner[3]});
  };
  return std::ranges::any_of(body.surface.triangles(), through_face) ||
         std::ranges::any_of(body.surface.edges(), edge_through);
}

}  // namespace

std::vector<bool> overlapping(std::span<const PlacedBody> bodies) {
  std::vector<collide::Aabb> boxes;
  for (const PlacedBody& body : bodies) boxes.push_back(collide::measure_bounds(body.at).box);
  std::vector<bool> found(bodies.size());
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if ((found[a] && found[b]) || !collide::near(boxes[a], boxes[b], 0.0f)) continue;
      if (lies_in(bodies[a], bodies[b]) || lies_in(bodies[b], bodies[a])) found[a] = found[b] = true;
    }
  return found;
}

bool overlap(const PlacedBody& body, const Solid& solid, bool between) {
  if (!solid.enabled) return false;
  for (collide::Index i = 0; i < body.at.size; ++i) {
    const glm::dvec3 x(body.at[i]);
    if (surface_at(solid, body.origin + x).distance < -shallow * body.mean_edge) return true;
  }
  const std::optional<SolidMiddle> middle = interior_of(solid).middle;
  return middle && (between || middle->depth > body.mean_edge) && holds(body, *middle);
}

}  // namespace softbody
