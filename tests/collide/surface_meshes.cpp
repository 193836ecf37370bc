#include "surface_meshes.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace collide::test {

using namespace collide::oracle;
using namespace collide::surface;

SurfaceMesh ball(float radius, int subdivisions) {
  Ball sphere = icosphere(subdivisions, radius);
  return {std::move(sphere.vertices), std::move(sphere.faces)};
}

SurfaceMesh box(const glm::vec3& lo, const glm::vec3& hi) {
  SurfaceMesh mesh;
  for (int k = 0; k < 8; ++k) {
    mesh.vertices.push_back(glm::vec3(k & 1 ? hi.x : lo.x, k & 2 ? hi.y : lo.y, k & 4 ? hi.z : lo.z));
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

SurfaceMesh sheet(int quads, float width) {
  SurfaceMesh mesh;
  const auto n = static_cast<Index>(quads);
  const float step = width / static_cast<float>(quads);
  for (Index i = 0; i <= n; ++i) {
    for (Index j = 0; j <= n; ++j) {
      mesh.vertices.push_back(
          glm::vec3(static_cast<float>(j) * step - width / 2, 0, static_cast<float>(i) * step - width / 2));
    }
  }
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const Index a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{a, c, d}, {a, d, b}});
    }
  }
  return mesh;
}

SurfaceMesh valley() {
  const std::vector<glm::vec3> outline{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}};
  SurfaceMesh mesh{outline, {}};
  for (const glm::vec3& p : outline) mesh.vertices.push_back(p + glm::vec3(0, 0, 1));
  for (const auto& [a, b, c] : std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}, {0, 3, 4}}) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + 5, b + 5, c + 5});
  }
  for (Index a = 0; a < 5; ++a) {
    const Index b = (a + 1) % 5;
    mesh.triangles.push_back({a, b, b + 5});
    mesh.triangles.push_back({a, b + 5, a + 5});
  }
  return mesh;
}

SurfaceMesh moved(SurfaceMesh mesh, const glm::vec3& by) {
  mesh.vertices = moved(std::move(mesh.vertices), by);
  return mesh;
}

SurfaceMesh turned(SurfaceMesh mesh, const glm::vec3& axis, float angle) {
  const glm::vec3 n = glm::normalize(axis);
  for (glm::vec3& v : mesh.vertices) {  // Rodrigues
    v = v * std::cos(angle) + glm::cross(n, v) * std::sin(angle) + n * (glm::dot(n, v) * (1 - std::cos(angle)));
  }
  return mesh;
}

double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const double length2 = glm::dot(b - a, b - a);
  const double t = length2 > 0 ? std::clamp(glm::dot(p - a, b - a) / length2, 0.0, 1.0) : 0;
  return glm::length(p - (a + t * (b - a)));
}

double distance_to_face(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double border =
      std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const bool inside = glm::dot(glm::cross(b - a, p - a), n) > 0 && glm::dot(glm::cross(c - b, p - b), n) > 0 &&
                      glm::dot(glm::cross(a - c, p - c), n) > 0;
  return inside ? std::min(border, std::abs(glm::dot(p - a, n)) / glm::length(n)) : border;
}

void Scene::add(const SurfaceMesh& mesh) {
  state.add(mesh.vertices);
  surfaces.push_back(std::make_shared<const Surface>(static_cast<Index>(mesh.vertices.size()), mesh.triangles));
}

Overlaps overlaps_of(const Scene& scene, int threads) {
  Workers workers(threads, 0);
  return find_overlaps(scene.frame(), scene.surfaces, workers);
}

SurfaceFigures figures_of(const Scene& scene) { return figures_of(scene.frame(), overlaps_of(scene)); }

std::vector<Crossing> crossings_of(const Scene& before, const Scene& after, int threads) {
  Workers workers(threads, 0);
  return find_crossings(before.frame(), after.frame(), before.surfaces, workers);
}

SurfaceFigures figures_of(const Scene& before, const Scene& after) {
  return figures_of(after.frame(), overlaps_of(after), crossings_of(before, after));
}

}  // namespace collide::test
