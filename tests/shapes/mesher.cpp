#include "tests/shapes/mesher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>

#include <glm/geometric.hpp>

namespace shapes {
namespace {

using glm::dvec3, glm::ivec3;
using softbody::Edge, softbody::Index, softbody::Mesh, softbody::Triangle;

constexpr double extent = 2;  // m, of the region that is searched, to either side

dvec3 gradient(const Distance& shape, const dvec3& p) {
  constexpr double step = 1e-5;
  dvec3 result;
  for (int k = 0; k < 3; ++k) {
    dvec3 to_side(0.0);
    to_side[k] = step;
    result[k] = (shape(p + to_side) - shape(p - to_side)) / (2 * step);
  }
  return result;
}

dvec3 projected(const Distance& shape, dvec3 p) {
  for (int i = 0; i < 4; ++i) {
    const dvec3 slope = gradient(shape, p);
    p -= shape(p) * slope / glm::dot(slope, slope);
  }
  return p;
}

/// Surface nets (Gibson 1998): a vertex in each cell of a grid that the surface crosses, and a quad of the four cells
/// around each crossed edge of the grid.
class SurfaceNet {
 public:
  SurfaceNet(const Distance& shape, double cell) : shape_(shape), cell_(cell) {
    int cells = 1;
    while (cells * cell < 2 * extent) cells *= 2;
    search({0, 0, 0}, cells);
    for (std::size_t v = 0; v < cell_of_.size(); ++v) add_quads(cell_of_[v]);
  }
  Mesh mesh;

 private:
  static std::uint64_t key(const ivec3& c) {
    return std::uint64_t(c.x) << 42 | std::uint64_t(c.y) << 21 | std::uint64_t(c.z);
  }
  dvec3 place(const dvec3& corner) const { return cell_ * corner - extent; }
  bool inside(const ivec3& corner) const { return shape_(place(dvec3(corner))) < 0; }

  /// Finds the cells of a cube of `size` cells that the surface crosses.
  void search(const ivec3& least, int size) {
    const double half = size / 2.0;
    if (std::abs(shape_(place(dvec3(least) + half))) > 2 * std::sqrt(3.0) * half * cell_) return;
    if (size == 1) return add_vertex(least);
    for (int octant = 0; octant < 8; ++octant)
      search(least + size / 2 * ivec3(octant >> 2, octant >> 1 & 1, octant & 1), size / 2);
  }

  void add_vertex(const ivec3& cell) {
    std::array<double, 8> value;
    for (int c = 0; c < 8; ++c) value[std::size_t(c)] = shape_(place(dvec3(cell + corner(c))));
    dvec3 sum(0.0);
    int crossings = 0;
    for (int c = 0; c < 8; ++c)
      for (int bit = 1; bit < 8; bit *= 2) {
        const double a = value[std::size_t(c)], b = value[std::size_t(c | bit)];
        if ((a < 0) == (b < 0)) continue;
        sum += glm::mix(dvec3(corner(c)), dvec3(corner(c | bit)), a / (a - b));
        ++crossings;
      }
    if (crossings == 0) return;
    vertex_in_[key(cell)] = Index(mesh.vertices.size());
    mesh.vertices.push_back(projected(shape_, place(dvec3(cell) + sum / double(crossings))));
    cell_of_.push_back(cell);
  }
  static ivec3 corner(int bits) { return {bits >> 2, bits >> 1 & 1, bits & 1}; }

  /// Adds the quads of the edges that begin at a cell's first corner.
  void add_quads(const ivec3& cell) {
    for (int axis = 0; axis < 3; ++axis) {
      ivec3 along(0), u(0), v(0);
      along[axis] = u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
      const bool from = inside(cell), to = inside(cell + along);
      if (from == to) continue;
      std::array quad{vertex_in_.at(key(cell - u - v)), vertex_in_.at(key(cell - v)), vertex_in_.at(key(cell)),
                      vertex_in_.at(key(cell - u))};
      if (to) std::swap(quad[1], quad[3]);
      const auto length = [&](int a, int b) {
        return glm::distance(mesh.vertices[quad[std::size_t(a)]], mesh.vertices[quad[std::size_t(b)]]);
      };
      const std::size_t s = length(0, 2) < length(1, 3) ? 0 : 1;
      mesh.triangles.push_back({quad[s], quad[s + 1], quad[s + 2]});
      mesh.triangles.push_back({quad[s], quad[s + 2], quad[(s + 3) % 4]});
    }
  }

  const Distance& shape_;
  double cell_;  // m
  std::unordered_map<std::uint64_t, Index> vertex_in_;
  std::vector<ivec3> cell_of_;  // of each vertex
};

dvec3 area_of(const Mesh& mesh, const Triangle& t) {
  const dvec3& a = mesh.vertices[t[0]];
  return glm::cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a) / 2.0;
}

/// Gives vertices nearer to six neighbours, or where that is no matter, triangles larger angles, by flips of edges
/// inside pairs of triangles.
void flip_edges(Mesh& mesh) {
  std::map<Edge, std::vector<std::size_t>> faces;
  std::vector<int> degree(mesh.vertices.size(), 0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      faces[softbody::ordered(mesh.triangles[f][std::size_t(k)], mesh.triangles[f][std::size_t(k + 1) % 3])].push_back(
          f);
      ++degree[mesh.triangles[f][std::size_t(k)]];
    }
  std::vector<bool> changed(mesh.triangles.size(), false);
  std::map<Edge, bool> added;
  const auto opposite = [&](std::size_t f, const Edge& e) {
    for (const Index corner : mesh.triangles[f])
      if (corner != e[0] && corner != e[1]) return corner;
    return e[0];
  };
  for (const auto& [edge, at] : faces) {
    if (at.size() != 2 || changed[at[0]] || changed[at[1]]) continue;
    const auto [i, j] = edge;
    const Index p = opposite(at[0], edge), q = opposite(at[1], edge);
    const Edge other = softbody::ordered(p, q);
    if (p == q || faces.contains(other) || added.contains(other)) continue;
    const auto excess = [&](Index v, int change) { return std::pow(degree[v] + change - 6, 2); };
    const double gain = excess(i, 0) + excess(j, 0) + excess(p, 0) + excess(q, 0) - excess(i, -1) - excess(j, -1) -
                        excess(p, 1) - excess(q, 1);
    const auto cosine = [&](Index apex, Index a, Index b) {
      return glm::dot(glm::normalize(mesh.vertices[a] - mesh.vertices[apex]),
                      glm::normalize(mesh.vertices[b] - mesh.vertices[apex]));
    };
    const bool not_delaunay = cosine(p, i, j) + cosine(q, i, j) < cosine(i, p, q) + cosine(j, p, q);
    if (gain < 0 || (gain == 0 && !not_delaunay)) continue;
    // The corners of the first triangle in its order: a, b on the edge, then p.
    Triangle t = mesh.triangles[at[0]];
    while (t[2] != p) std::rotate(t.begin(), t.begin() + 1, t.end());
    const Triangle one{p, t[0], q}, two{q, t[1], p};
    const dvec3 before = area_of(mesh, mesh.triangles[at[0]]) + area_of(mesh, mesh.triangles[at[1]]);
    const double flat = 0.2 * glm::dot(before, before) / 2;
    if (glm::dot(area_of(mesh, one), before) < flat || glm::dot(area_of(mesh, two), before) < flat) continue;
    mesh.triangles[at[0]] = one, mesh.triangles[at[1]] = two;
    changed[at[0]] = changed[at[1]] = true;
    added[other] = true;
    --degree[i], --degree[j], ++degree[p], ++degree[q];
  }
}

/// Moves vertices along the surface towards the centres of the triangles around them, weighted by areas.
void relax(Mesh& mesh, const Distance& shape) {
  std::vector<dvec3> sum(mesh.vertices.size(), dvec3(0.0)), normal = sum;
  std::vector<double> weight(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    const dvec3 area = area_of(mesh, t);
    const dvec3 centre = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
    for (const Index corner : t) {
      sum[corner] += glm::length(area) * centre;
      weight[corner] += glm::length(area);
      normal[corner] += area;
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) {
    const dvec3 n = glm::normalize(normal[v]), step = sum[v] / weight[v] - mesh.vertices[v];
    mesh.vertices[v] = projected(shape, mesh.vertices[v] + 0.8 * (step - glm::dot(step, n) * n));
  }
}

}  // namespace

Mesh make_mesh(const Distance& shape, int vertices) {
  double cell = extent / 16;
  for (int i = 0; i < 4; ++i)
    cell *= std::sqrt(double(SurfaceNet(shape, cell).mesh.vertices.size()) / double(vertices));
  Mesh mesh = SurfaceNet(shape, cell).mesh;
  for (int pass = 0; pass < 30; ++pass) {
    if (pass < 20) flip_edges(mesh);
    relax(mesh, shape);
  }
  return mesh;
}

}  // namespace shapes
