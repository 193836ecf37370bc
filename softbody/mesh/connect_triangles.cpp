// The net of springs of a triangle mesh, so that a material bends and stretches alike at every resolution.
//
// A regular net of springs k is a sheet of Young's modulus times thickness 2 k / sqrt(3), however long its edges are.
// In any other net a spring of length L between triangles of the areas A and B has the share 2 (A + B) / (sqrt(3) L^2)
// of k (van Gelder 1998, "Approximate simulation of elastic membranes by triangulated spring meshes"), which is 1 in a
// regular one. So a stretch that is the same everywhere takes the energy that it takes in the sheet. A mesh in which
// all shares are near 1 counts as regular, as the paper's sphere does: its springs are all alike.
//
// A bend spring joins the ends of a straight line on the surface, across the middle of an edge and square to it. Its
// length decides how stiff it is: springs from corner to corner across an edge fold easier, the shorter the edges. So
// all resolutions have springs of the length that they have in the net that materials are stated for. With the share
// 2 sqrt(3) (A + B) / length^2 they also stretch alike: it is 1 from corner to corner in a regular net.

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "collide/surface/surface.h"
#include "softbody/mesh/mesh.h"

namespace softbody {
namespace {

using glm::dvec2, glm::dvec3;

using collide::surface::Surface;

/// The triangles at an edge, and the corners opposite to it of two of them, ascending.
struct EdgeFaces {
  int faces = 0;
  std::array<Index, 2> corner{};
};

EdgeFaces faces_at(const Surface& surface, const Edge& edge) {
  EdgeFaces at;
  for (const Index face : surface.triangles_at(edge[0])) {
    const Triangle& t = surface.triangles()[face];
    if (std::ranges::count(t, edge[1]) == 0) continue;
    if (at.faces < 2)
      at.corner[std::size_t(at.faces)] =
          *std::ranges::find_if(t, [&](Index c) { return c != edge[0] && c != edge[1]; });
    ++at.faces;
  }
  if (at.faces > 1) std::ranges::sort(at.corner);
  return at;
}

/// A straight line on the surface. It has come through the edge from a to b at a distance `at` from a and goes on into
/// the triangle whose third corner is c. Its direction: along the edge, and from there into the triangle.
struct Walk {
  const Mesh& mesh;
  const Surface& surface;
  Index a, b, c;
  double at;
  dvec2 direction{0, 1};

  struct End {
    Index vertex;
    double distance;  // m, how far along the line it is
  };
  /// Returns the vertex nearest to where the line is after `distance`, or where it leaves the mesh; but c if that is in
  /// the first triangle.
  End go(double distance) {
    double gone = 0;
    for (int triangles = 0; triangles < max_triangles; ++triangles) {
      const dvec3 edge = mesh.vertices[b] - mesh.vertices[a], side = mesh.vertices[c] - mesh.vertices[a];
      const double length = glm::length(edge), along = glm::dot(side, edge) / length;
      const dvec2 here(at, 0), third(along, glm::length(side - along / length * edge));
      // The line meets the side from b to c if it passes c on the right, else that from c to a.
      const bool at_b = cross(direction, third - here) > 0;
      const dvec2 from = at_b ? dvec2(length, 0) : third, to = at_b ? third : dvec2(0, 0);
      const double turn = cross(direction, to - from);
      const double exit = turn > 0 ? cross(from - here, to - from) / turn : 0;
      const EdgeFaces exit_edge = faces_at(surface, at_b ? ordered(b, c) : ordered(c, a));
      if (gone + exit >= distance || exit_edge.faces != 2) {
        const dvec2 last = here + std::min(exit, distance - gone) * direction;
        const Index vertex = triangles == 0 ? c : nearest(last, length, third);
        const dvec2 place = vertex == c ? third : vertex == b ? dvec2(length, 0) : dvec2(0, 0);
        return {vertex, gone + glm::dot(place - here, direction)};
      }
      gone += exit;
      const dvec2 way = glm::normalize(to - from);
      at = glm::dot(here + exit * direction - from, way);
      direction = {glm::dot(direction, way), -cross(way, direction)};
      const Index behind = at_b ? a : b;
      std::tie(a, b) = at_b ? std::pair(b, c) : std::pair(c, a);
      c = exit_edge.corner[exit_edge.corner[0] == behind];
    }
    return {a, gone};
  }

 private:
  static constexpr int max_triangles = 1000;  // where some have no area, a line may not get on
  static double cross(const dvec2& u, const dvec2& v) { return u.x * v.y - u.y * v.x; }
  Index nearest(const dvec2& p, double length, const dvec2& third) const {
    const double to_a = glm::length(p), to_b = glm::distance(p, dvec2(length, 0)), to_c = glm::distance(p, third);
    return to_c <= std::min(to_a, to_b) ? c : to_a <= to_b ? a : b;
  }
};

constexpr double max_share = 2;  // so that needles hardly need shorter steps than other triangles

double length2_of(const Mesh& mesh, const Edge& e) {
  const dvec3 d = mesh.vertices[e[1]] - mesh.vertices[e[0]];
  return glm::dot(d, d);
}

double areas_of(const Mesh& mesh, const Edge& e, const EdgeFaces& at) {
  double sum = 0;
  for (int k = 0; k < std::min(at.faces, 2); ++k) {
    const dvec3& a = mesh.vertices[e[0]];
    sum += glm::length(glm::cross(mesh.vertices[e[1]] - a, mesh.vertices[at.corner[std::size_t(k)]] - a)) / 2;
  }
  return sum;
}

void join_bend_pairs(Mesh& mesh, const Surface& surface, double all_areas, bool regular) {
  const bool all_alike = regular && double(mesh.vertices.size()) <= mesh.stated_for;
  // In a regular mesh that materials are stated for: 2 V - 4 equal triangles, and springs of twice their height.
  const double length = std::sqrt(3.0) * std::sqrt(4 / std::sqrt(3.0) * all_areas / (2 * mesh.stated_for - 4));
  std::vector<std::pair<Edge, double>> shares;
  for (const Edge& e : surface.edges()) {
    const EdgeFaces at = faces_at(surface, e);
    if (at.faces != 2) continue;
    const double middle = std::sqrt(length2_of(mesh, e)) / 2;
    const auto walk = [&](std::size_t side) { return Walk{mesh, surface, e[0], e[1], at.corner[side], middle}; };
    // The second half makes up for what the nearest vertex is too near or too far in the first.
    const Walk::End one = walk(0).go(length / 2);
    const Walk::End two = walk(1).go(length - one.distance);
    if (one.vertex == two.vertex) continue;  // around a thin part
    const Edge ends = ordered(one.vertex, two.vertex);
    const double reach = std::max(one.distance + two.distance, std::sqrt(length2_of(mesh, ends)));
    const double by_area = 2 * std::sqrt(3.0) * areas_of(mesh, e, at) / (reach * reach);
    shares.push_back({ends, all_alike ? 1 : std::min(max_share, by_area)});
  }
  std::ranges::sort(shares);
  for (const auto& [ends, share] : shares) {
    if (mesh.bend_pairs.empty() || mesh.bend_pairs.back() != ends) {
      mesh.bend_pairs.push_back(ends);
      mesh.bend_shares.push_back(0);
    }
    mesh.bend_shares.back() += share;
  }
}

}  // namespace

void connect_triangles(Mesh& mesh) {
  Mesh bare;
  bare.vertices = std::move(mesh.vertices);
  bare.triangles = std::move(mesh.triangles);
  mesh = std::move(bare);
  const Surface surface(static_cast<Index>(mesh.vertices.size()), mesh.triangles);
  mesh.closed = !mesh.triangles.empty();
  double all_areas = 0, of_shares = 0;
  mesh.edges = surface.edges();
  for (const Edge& e : mesh.edges) {
    const EdgeFaces at = faces_at(surface, e);
    const double areas = areas_of(mesh, e, at);
    mesh.edge_shares.push_back(std::min(max_share, 2 / std::sqrt(3.0) * areas / length2_of(mesh, e)));
    all_areas += areas / 3;
    of_shares += mesh.edge_shares.back() * length2_of(mesh, e) / (2 * std::sqrt(3.0));
    if (at.faces != 2) mesh.closed = false;
  }
  const bool regular = std::ranges::all_of(mesh.edge_shares, [](double s) { return std::abs(s - 1) < 0.25; });
  const double factor = of_shares > 0 ? all_areas / of_shares : 1;
  for (double& share : mesh.edge_shares) share = regular ? 1 : std::min(max_share, share * factor);
  join_bend_pairs(mesh, surface, all_areas, regular);
}

}  // namespace softbody
