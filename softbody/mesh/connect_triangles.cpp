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
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "softbody/mesh/mesh.h"

namespace softbody {
namespace {

using glm::dvec2, glm::dvec3;

/// An edge and the corners opposite to it, of the first two triangles that have it.
struct EdgeFaces {
  Edge edge;
  int faces = 0;
  std::array<Index, 2> corner{};
};

/// The edges of a mesh in ascending order.
class EdgeTable {
 public:
  explicit EdgeTable(const Mesh& mesh) : first_(mesh.vertices.size() + 1, 0) {
    std::vector<std::pair<Edge, Index>> sides;
    for (const Triangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k) sides.push_back({ordered(t[k], t[(k + 1) % 3]), t[(k + 2) % 3]});
    std::ranges::sort(sides);
    for (const auto& [edge, corner] : sides) {
      if (edges_.empty() || edges_.back().edge != edge) {
        edges_.push_back({edge});
        ++first_[edge[0] + 1];
      }
      EdgeFaces& e = edges_.back();
      if (e.faces < 2) e.corner[std::size_t(e.faces)] = corner;
      ++e.faces;
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
  }
  const std::vector<EdgeFaces>& all() const { return edges_; }
  const EdgeFaces& find(const Edge& edge) const {
    std::size_t at = first_[edge[0]];
    while (edges_[at].edge[1] != edge[1]) ++at;
    return edges_[at];
  }

 private:
  std::vector<EdgeFaces> edges_;
  std::vector<std::size_t> first_;  // of each vertex, of the edges that begin there
};

/// A straight line on the surface. It has come through the edge from a to b at a distance `at` from a and goes on into
/// the triangle whose third corner is c. Its direction: along the edge, and from there into the triangle.
struct Walk {
  const Mesh& mesh;
  const EdgeTable& edges;
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
      const EdgeFaces& exit_edge = edges.find(at_b ? ordered(b, c) : ordered(c, a));
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

/// The edges, bend pairs and shares of a mesh, found from its triangles.
class Net {
 public:
  explicit Net(Mesh& mesh) : mesh_(mesh), edges_(mesh) {}

  void fill() {
    mesh_.closed = !mesh_.triangles.empty();
    double all_areas = 0, of_shares = 0;
    for (const EdgeFaces& e : edges_.all()) {
      const double areas = areas_at(e);
      mesh_.edges.push_back(e.edge);
      mesh_.edge_shares.push_back(std::min(max_share, 2 / std::sqrt(3.0) * areas / length2(e.edge)));
      all_areas += areas / 3;
      of_shares += mesh_.edge_shares.back() * length2(e.edge) / (2 * std::sqrt(3.0));
      if (e.faces != 2) mesh_.closed = false;
    }
    const bool regular = std::ranges::all_of(mesh_.edge_shares, [](double s) { return std::abs(s - 1) < 0.25; });
    const double factor = of_shares > 0 ? all_areas / of_shares : 1;
    for (double& share : mesh_.edge_shares) share = regular ? 1 : std::min(max_share, share * factor);
    join_bend_pairs(all_areas, regular);
  }

 private:
  static constexpr double max_share = 2;  // so that needles hardly need shorter steps than other triangles

  double length2(const Edge& e) const {
    const dvec3 d = mesh_.vertices[e[1]] - mesh_.vertices[e[0]];
    return glm::dot(d, d);
  }
  double areas_at(const EdgeFaces& e) const {
    double sum = 0;
    for (int k = 0; k < std::min(e.faces, 2); ++k) {
      const dvec3& a = mesh_.vertices[e.edge[0]];
      sum += glm::length(glm::cross(mesh_.vertices[e.edge[1]] - a, mesh_.vertices[e.corner[std::size_t(k)]] - a)) / 2;
    }
    return sum;
  }

  void join_bend_pairs(double all_areas, bool regular) {
    const bool all_alike = regular && double(mesh_.vertices.size()) <= mesh_.stated_for;
    // In a regular mesh that materials are stated for: 2 V - 4 equal triangles, and springs of twice their height.
    const double length = std::sqrt(3.0) * std::sqrt(4 / std::sqrt(3.0) * all_areas / (2 * mesh_.stated_for - 4));
    std::vector<std::pair<Edge, double>> shares;
    for (const EdgeFaces& e : edges_.all()) {
      if (e.faces != 2) continue;
      const double middle = std::sqrt(length2(e.edge)) / 2;
      const auto walk = [&](std::size_t side) {
        return Walk{mesh_, edges_, e.edge[0], e.edge[1], e.corner[side], middle};
      };
      // The second half makes up for what the nearest vertex is too near or too far in the first.
      const Walk::End one = walk(0).go(length / 2);
      const Walk::End two = walk(1).go(length - one.distance);
      if (one.vertex == two.vertex) continue;  // around a thin part
      const Edge ends = ordered(one.vertex, two.vertex);
      const double reach = std::max(one.distance + two.distance, std::sqrt(length2(ends)));
      const double by_area = 2 * std::sqrt(3.0) * areas_at(e) / (reach * reach);
      shares.push_back({ends, all_alike ? 1 : std::min(max_share, by_area)});
    }
    std::ranges::sort(shares);
    for (const auto& [ends, share] : shares) {
      if (mesh_.bend_pairs.empty() || mesh_.bend_pairs.back() != ends) {
        mesh_.bend_pairs.push_back(ends);
        mesh_.bend_shares.push_back(0);
      }
      mesh_.bend_shares.back() += share;
    }
  }

  Mesh& mesh_;
  EdgeTable edges_;
};

}  // namespace

void connect_triangles(Mesh& mesh) {
  Mesh connected;
  connected.vertices = std::move(mesh.vertices);
  connected.triangles = std::move(mesh.triangles);
  Net(connected).fill();
  mesh = std::move(connected);
}

}  // namespace softbody
