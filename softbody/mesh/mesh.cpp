#include "softbody/mesh/mesh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <unordered_map>

#include <glm/geometric.hpp>

namespace softbody {
namespace {

Mesh icosahedron() {
  const double p = (1.0 + std::sqrt(5.0)) / 2.0;
  Mesh mesh;
  mesh.vertices = {{-1, p, 0},  {1, p, 0},  {-1, -p, 0}, {1, -p, 0}, {0, -1, p},  {0, 1, p},
                   {0, -1, -p}, {0, 1, -p}, {p, 0, -1},  {p, 0, 1},  {-p, 0, -1}, {-p, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

void subdivide(Mesh& mesh) {
  std::map<Edge, Index> middle;
  const auto midpoint = [&](Index a, Index b) {
    const auto [it, fresh] = middle.try_emplace(ordered(a, b), static_cast<Index>(mesh.vertices.size()));
    if (fresh) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) * 0.5);
    return it->second;
  };
  std::vector<Triangle> finer;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Index ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(finer);
}

}  // namespace

Mesh icosphere(int subdivisions, double radius) {
  assert(subdivisions >= 0 && subdivisions <= 6 && radius > 0);
  Mesh mesh = icosahedron();
  for (int s = 0; s < subdivisions; ++s) {
    for (auto& v : mesh.vertices) v = glm::normalize(v);
    subdivide(mesh);
  }
  for (auto& v : mesh.vertices) v = radius * glm::normalize(v);
  connect_triangles(mesh);
  return mesh;
}

Mesh quad_grid(int columns, int rows, double width, double depth) {
  assert(columns >= 1 && rows >= 1);
  Mesh mesh;
  mesh.stated_for = 57 * 57;
  const double finer = double(columns + 1) * double(rows + 1) / mesh.stated_for;
  const int steps = std::max(1, int(std::lround(std::sqrt(finer)))), span = 2 * steps;
  const auto at = [&](int c, int r) { return static_cast<Index>(r * (columns + 1) + c); };
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c)
      mesh.vertices.emplace_back((double(c) / columns - 0.5) * width, 0.0, (double(r) / rows - 0.5) * depth);
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) {
      if (c < columns) mesh.edges.push_back({at(c, r), at(c + 1, r)});
      if (r < rows) mesh.edges.push_back({at(c, r), at(c, r + 1)});
      if (c + span <= columns) mesh.bend_pairs.push_back({at(c, r), at(c + span, r)});
      if (r + span <= rows) mesh.bend_pairs.push_back({at(c, r), at(c, r + span)});
      if (c == columns || r == rows) continue;
      const Index a = at(c, r), b = at(c, r + 1), d = at(c + 1, r), e = at(c + 1, r + 1);
      mesh.shear_pairs.push_back(ordered(a, e));
      mesh.shear_pairs.push_back(ordered(b, d));
      // Alternating diagonals keep the drawn sheet free of a preferred direction.
      if ((c + r) % 2 == 0)
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, e}, {a, e, d}});
      else
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, e, d}});
    }
  for (auto* pairs : {&mesh.edges, &mesh.bend_pairs, &mesh.shear_pairs}) std::ranges::sort(*pairs);
  mesh.bend_shares.assign(mesh.bend_pairs.size(), 1.0 / (steps * steps));  // as many more pull side by side
  return mesh;
}

std::vector<Index> renumber_vertices(std::vector<Triangle>& triangles) {
  std::vector<Index> old;
  std::unordered_map<Index, Index> number;
  for (Triangle& t : triangles)
    for (Index& corner : t) {
      const auto [known, is_new] = number.try_emplace(corner, static_cast<Index>(old.size()));
      if (is_new) old.push_back(corner);
      corner = known->second;
    }
  return old;
}

double volume(const std::vector<glm::dvec3>& vertices, const std::vector<Triangle>& triangles) {
  double six = 0;
  for (const auto& [a, b, c] : triangles) six += glm::dot(vertices[a], glm::cross(vertices[b], vertices[c]));
  return six / 6;
}

double bounding_radius(const Mesh& mesh) {
  glm::dvec3 mean{0.0};
  for (const auto& v : mesh.vertices) mean += v / double(mesh.vertices.size());
  double radius = 0;
  for (const auto& v : mesh.vertices) radius = std::max(radius, glm::distance(v, mean));
  return radius;
}

/// The farthest point is the circumcentre, or lies on the longest side of an obtuse face, as far from the end of the
/// second longest side as from the opposite corner.
double covering_radius(const Mesh& mesh) {
  double radius = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const glm::dvec3 &x = mesh.vertices[i], &y = mesh.vertices[j], &z = mesh.vertices[k];
    std::array sides{glm::distance(x, y), glm::distance(y, z), glm::distance(z, x)};
    std::sort(sides.begin(), sides.end());
    const auto [a, b, c] = sides;
    if (c == 0) continue;
    const bool obtuse = c * c >= a * a + b * b;
    radius = std::max(
        radius, obtuse ? b * b * c / (b * b + c * c - a * a) : a * b * c / (2 * glm::length(glm::cross(y - x, z - x))));
  }
  return radius;
}

}  // namespace softbody
