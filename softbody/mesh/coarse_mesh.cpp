#include "softbody/mesh/coarse_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <utility>

#include <meshoptimizer.h>
#include <glm/geometric.hpp>

#include "collide/core/workers.h"
#include "collide/oracle/surface_oracle.h"
#include "collide/surface/box_tree.h"
#include "collide/surface/closest_features.h"
#include "softbody/mesh/sets.h"
#include "softbody/mesh/surface.h"

namespace softbody {
namespace {

constexpr int max_tries = 8;

/// The triangles of a mesh in a tree.
class FaceTree {
 public:
  FaceTree(std::span<const glm::vec3> vertices, const std::vector<Triangle>& triangles)
      : vertices_(vertices), triangles_(triangles) {
    std::vector<collide::surface::Box> boxes(triangles.size());
    for (std::size_t t = 0; t < boxes.size(); ++t)
      for (const Index corner : triangles[t]) boxes[t].add(glm::dvec3(vertices[corner]));
    tree_ = collide::surface::BoxTree(boxes);
  }

  collide::surface::Box box() const { return tree_.box(); }

  collide::surface::Closest closest(const glm::vec3& point, Index face) const {
    const auto& [a, b, c] = triangles_[face];
    return collide::surface::closest_vertex_face(point, vertices_[a], vertices_[b], vertices_[c]);
  }

  /// Returns the nearest triangle for which may(face) is true; its distance (m) is infinite if there is none. guess: a
  /// triangle that is likely to be near.
  auto nearest(const glm::vec3& point, Index guess, const auto& may) const {
    return tree_.nearest(glm::dvec3(point), guess, [&](Index face) {
      return may(face) ? double(glm::length(closest(point, face).separation)) : double{INFINITY};
    });
  }

 private:
  std::span<const glm::vec3> vertices_;
  const std::vector<Triangle>& triangles_;
  collide::surface::BoxTree tree_;
};

/// Returns a number for each vertex, the same for those that edges connect.
std::vector<Index> parts_of(const Mesh& mesh) {
  Sets joined(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) joined.unite(a, b), joined.unite(a, c);
  std::vector<Index> part;
  for (Index v = 0; v < mesh.vertices.size(); ++v) part.push_back(joined.find(v));
  return part;
}

/// Returns the triangles at each edge; ascending.
std::map<Edge, std::vector<Index>> faces_at_edges(const std::vector<Triangle>& triangles) {
  std::map<Edge, std::vector<Index>> faces;
  for (Index f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) faces[ordered(triangles[f][k], triangles[f][(k + 1) % 3])].push_back(f);
  return faces;
}

/// Returns the normal of a triangle, of any length.
auto area_normal(const auto& at, const Triangle& t) { return glm::cross(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]); }

/// Removes blisters: a few triangles that hang together and are joined to many others along edges of more than two
/// triangles only. Edge collapses leave them, mostly as two triangles with the same corners.
void cut_off_blisters(std::vector<Triangle>& triangles) {
  const std::map<Edge, std::vector<Index>> faces = faces_at_edges(triangles);
  Sets joined(triangles.size());
  for (const auto& [edge, at] : faces)
    if (at.size() == 2) joined.unite(at[0], at[1]);
  std::vector<std::size_t> size(triangles.size(), 0), of_largest(triangles.size(), 0);
  for (Index f = 0; f < triangles.size(); ++f) ++size[joined.find(f)];
  for (const auto& [edge, at] : faces) {
    if (at.size() <= 2) continue;
    std::size_t largest = 0;
    for (const Index f : at) largest = std::max(largest, size[joined.find(f)]);
    for (const Index f : at) of_largest[joined.find(f)] = std::max(of_largest[joined.find(f)], largest);
  }
  constexpr std::size_t many = 20;  // times the triangles of a blister
  std::vector<Triangle> left;
  for (Index f = 0; f < triangles.size(); ++f)
    if (many * size[joined.find(f)] > of_largest[joined.find(f)]) left.push_back(triangles[f]);
  triangles = std::move(left);
}

/// Returns the cosine of the smallest angle of a triangle; 1 if it has no area.
double cosine_of_smallest_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const auto cosine = [](const glm::dvec3& u, const glm::dvec3& v) {
    const double lengths = glm::length(u) * glm::length(v);
    return lengths > 0 ? glm::dot(u, v) / lengths : 1.0;
  };
  return std::max({cosine(b - a, c - a), cosine(c - b, a - b), cosine(a - c, b - c)});
}

/// Flips edges between two triangles where that makes their smallest angle larger and hardly bends the surface.
void flip_edges(Mesh& mesh) {
  constexpr double straight = 0.99;  // the least cosine between the normals before and after
  constexpr int max_passes = 10;
  const auto& at = mesh.vertices;
  const auto slimness = [&](const Triangle& t) { return cosine_of_smallest_angle(at[t[0]], at[t[1]], at[t[2]]); };
  for (int pass = 0, flips = 1; pass < max_passes && flips > 0; ++pass) {
    flips = 0;
    const std::map<Edge, std::vector<Index>> faces = faces_at_edges(mesh.triangles);
    std::vector<char> flipped(mesh.triangles.size(), false);
    std::set<Edge> made;
    for (const auto& [edge, both] : faces) {
      if (both.size() != 2 || flipped[both[0]] || flipped[both[1]]) continue;
      Triangle &left = mesh.triangles[both[0]], &right = mesh.triangles[both[1]];
      while (edge != ordered(left[0], left[1])) std::rotate(left.begin(), left.begin() + 1, left.end());
      while (edge != ordered(right[0], right[1])) std::rotate(right.begin(), right.begin() + 1, right.end());
      const auto [a, b, c] = left;
      const Index d = right[2];
      const Edge across = ordered(c, d);
      if (c == d || faces.contains(across) || made.contains(across)) continue;
      const Triangle one{a, d, c}, other{d, b, c};
      if (std::max(slimness(one), slimness(other)) >= std::max(slimness(left), slimness(right)) - 1e-6) continue;
      const glm::dvec3 before = area_normal(at, left) + area_normal(at, right);
      const auto bends = [&](const Triangle& t) {
        const glm::dvec3 n = area_normal(at, t);
        return !(glm::dot(n, before) > straight * glm::length(n) * glm::length(before));
      };
      if (bends(one) || bends(other)) continue;
      left = one, right = other;
      flipped[both[0]] = flipped[both[1]] = true;
      made.insert(across);
      ++flips;
    }
  }
}

class Coarsener {
 public:
  explicit Coarsener(const Mesh& fine)
      : fine_(fine),
        at_(fine.vertices.begin(), fine.vertices.end()),
        part_(parts_of(fine)),
        normal_(at_.size(), glm::vec3(0.0f)),
        faces_(at_, fine.triangles) {
    std::vector<Triangle> turned = fine.triangles;
    for (const SurfacePart& p : align(turned)) {
      const Index part = part_[turned[p.faces[0]][0]];
      if (!p.closed)
        open_.insert(part);
      else if (volume(fine.vertices, fine.triangles, p) < 0)
        cavities_.insert(part);
    }
    for (const Triangle& t : fine.triangles)
      for (const Index corner : t) normal_[corner] += area_normal(at_, t);
    const glm::dvec3 size = faces_.box().hi - faces_.box().lo;
    extent_ = static_cast<float>(std::max({size.x, size.y, size.z}));
  }

  std::optional<CoarseMesh> run(std::size_t vertices) const {
    std::optional<Mesh> best;
    std::vector<Index> kept;
    std::size_t least = 0;
    double roughness = 1e-3;
    for (int i = 0; i < max_tries; ++i, roughness /= 2) {
      auto [mesh, from] = simplified(vertices, roughness, static_cast<unsigned>(i));
      if (mesh.vertices.size() == at_.size() || !has_same_form(mesh, from)) continue;
      const std::size_t crossings = crossings_of(mesh);
      if (!best || crossings < least) best = std::move(mesh), kept = std::move(from), least = crossings;
      if (least == 0) break;
    }
    if (!best) return {};
    connect_triangles(*best);
    return embedded(std::move(*best), kept, least);
  }

 private:
  /// Returns a mesh without edges, and the fine vertex that each of its vertices was. roughness: see rough().
  std::pair<Mesh, std::vector<Index>> simplified(std::size_t vertices, double roughness, unsigned seed) const {
    const std::vector<glm::vec3> at = rough(roughness, seed);
    std::vector<unsigned> corners;
    for (const Triangle& t : fine_.triangles) corners.insert(corners.end(), t.begin(), t.end());
    // A surface has about two triangles a vertex.
    const std::size_t target = std::min(corners.size(), 6 * vertices);
    std::vector<unsigned> left(corners.size());
    left.resize(meshopt_simplify(left.data(), corners.data(), corners.size(), &at[0].x, at.size(), sizeof(glm::vec3),
                                 target, 1.0f));
    Mesh mesh;
    for (std::size_t i = 0; i < left.size(); i += 3) mesh.triangles.push_back({left[i], left[i + 1], left[i + 2]});
    cut_off_blisters(mesh.triangles);
    std::vector<Index> from = renumber_vertices(mesh.triangles);
    for (const Index v : from) mesh.vertices.push_back(fine_.vertices[v]);
    flip_edges(mesh);
    return {std::move(mesh), std::move(from)};
  }

  /// Returns the vertices, moved along their normals at random by up to so much, relative to the mesh's extent. Where a
  /// surface is smooth, edge collapses leave slivers, and where it is flat, pinched edges with more than two faces: to
  /// them all of its triangles are alike. On a rough one they leave triangles of about one size.
  std::vector<glm::vec3> rough(double roughness, unsigned seed) const {
    std::mt19937 random(seed);
    const float most = static_cast<float>(roughness) * extent_;
    std::vector<glm::vec3> points = at_;
    for (std::size_t v = 0; v < points.size(); ++v) {
      const float share = 2 * static_cast<float>(random()) / static_cast<float>(std::mt19937::max()) - 1;
      const float length = glm::length(normal_[v]);
      if (length > 0) points[v] += share * most / length * normal_[v];
    }
    return points;
  }

  /// True if the mesh is a surface with as many parts as the fine one, closed where that is, and the same side out.
  bool has_same_form(const Mesh& mesh, const std::vector<Index>& from) const {
    try {
      std::vector<Triangle> turned = mesh.triangles;
      const std::vector<SurfacePart> parts = align(turned);
      if (turned != mesh.triangles) return false;
      for (const SurfacePart& p : parts) {
        const Index part = part_[from[turned[p.faces[0]][0]]];
        const bool inwards = p.closed && volume(mesh.vertices, turned, p) < 0;
        if (p.closed ? inwards != cavities_.contains(part) : !open_.contains(part)) return false;
      }
    } catch (const SurfaceError&) {
      return false;
    }
    std::vector<Triangle> outlines = mesh.triangles;  // two with the same corners enclose nothing
    for (Triangle& t : outlines) std::ranges::sort(t);
    std::ranges::sort(outlines);
    if (std::ranges::adjacent_find(outlines) != outlines.end()) return false;
    std::set<Index> there;
    for (const Index v : from) there.insert(part_[v]);
    return there == std::set<Index>(part_.begin(), part_.end());
  }

  static std::size_t crossings_of(const Mesh& mesh) {
    const auto surface =
        std::make_shared<const collide::surface::Surface>(static_cast<Index>(mesh.vertices.size()), mesh.triangles);
    Points at;
    at.add(mesh.vertices);
    collide::Bodies bodies;
    bodies.add(std::make_shared<collide::Shape>(surface->vertex_count(), surface->edges()));
    collide::Workers workers(1);
    return collide::oracle::find_overlaps({at.x, at.y, at.z, &bodies}, {surface}, workers).piercings.size();
  }

  CoarseMesh embedded(Mesh mesh, const std::vector<Index>& from, std::size_t crossings) const {
    const std::vector<glm::vec3> coarse(mesh.vertices.begin(), mesh.vertices.end());
    const FaceTree tree(coarse, mesh.triangles);
    std::vector<Embedding::Hold> holds;
    double farthest = 0;
    Index guess = 0;
    for (Index v = 0; v < at_.size(); ++v) {
      const auto same_part = [&](Index face) { return part_[from[mesh.triangles[face][0]]] == part_[v]; };
      // A vertex on one side of a thin wall must not hold on to the other side.
      const auto same_side = [&](Index face) {
        return same_part(face) && glm::dot(area_normal(coarse, mesh.triangles[face]), normal_[v]) > 0;
      };
      auto nearest = tree.nearest(at_[v], guess, same_side);
      if (nearest.distance == INFINITY) nearest = tree.nearest(at_[v], guess, same_part);
      guess = nearest.item;
      const Triangle& t = mesh.triangles[guess];
      const collide::surface::Closest closest = tree.closest(at_[v], guess);
      const glm::vec3 weight(closest.weight[1], closest.weight[2], closest.weight[3]);
      glm::dvec3 foot(0.0);
      for (int k = 0; k < 3; ++k) foot += double(weight[k]) * mesh.vertices[t[std::size_t(k)]];
      holds.push_back({t, weight, glm::vec3(fine_.vertices[v] - foot)});
      farthest = std::max(farthest, nearest.distance);
    }
    guess = 0;  // of the fine mesh from here on
    for (const Triangle& t : mesh.triangles) {
      const glm::vec3 &a = coarse[t[0]], &b = coarse[t[1]], &c = coarse[t[2]];
      for (const glm::vec3& p : {0.5f * (a + b), 0.5f * (b + c), 0.5f * (c + a), (a + b + c) / 3.0f}) {
        const auto nearest = faces_.nearest(p, guess, [](Index) { return true; });
        guess = nearest.item;
        farthest = std::max(farthest, nearest.distance);
      }
    }
    Embedding embedding(mesh, std::move(holds));
    return {std::move(mesh), std::move(embedding), farthest, crossings};
  }

  const Mesh& fine_;
  std::vector<glm::vec3> at_;      // its vertices
  std::vector<Index> part_;        // of each of them
  std::set<Index> open_;           // parts that have edges with one triangle only
  std::set<Index> cavities_;       // closed parts that face inwards
  std::vector<glm::vec3> normal_;  // at each of them, of any length
  FaceTree faces_;                 // of its triangles
  float extent_;                   // m, the largest one
};

}  // namespace

std::optional<CoarseMesh> coarsen(const Mesh& fine, std::size_t vertices) {
  assert(vertices >= 4 && vertices < fine.vertices.size());
  const Coarsener coarsener(fine);
  // Many parts, and thin ones, need more vertices than were asked for.
  for (std::size_t most = vertices; most < fine.vertices.size(); most *= 2)
    if (std::optional<CoarseMesh> coarse = coarsener.run(most)) return coarse;
  return {};
}

}  // namespace softbody
