#include "softbody/model/body_model.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "collide/surface/surface.h"

namespace softbody {
namespace {

/// True if the area vectors of the faces cancel each other but for a tenth, as they do in closed meshes.
bool nearly_closed(const Mesh& mesh) {
  glm::dvec3 sum(0.0);
  double size = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::dvec3 area = glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
    sum += area;
    size += glm::length(area);
  }
  return mesh.closed || glm::length(sum) < 0.1 * size;
}

BodyMesh body_mesh(Mesh mesh) {
  BodyMesh made;
  const std::vector<glm::vec3> rest(mesh.vertices.begin(), mesh.vertices.end());
  const Index count = static_cast<Index>(rest.size());
  made.radius = bounding_radius(mesh);
  made.covering = covering_radius(mesh);
  made.surface = std::make_shared<collide::surface::Surface>(count, mesh.triangles);
  for (const auto& [i, j] : made.surface->edges()) made.mean_edge += glm::distance(rest[i], rest[j]);
  made.mean_edge /= double(std::max<std::size_t>(1, made.surface->edges().size()));
  made.shape =
      std::make_shared<collide::Shape>(std::make_shared<collide::Topology>(count, mesh.edges, mesh.triangles), rest);
  made.mesh = std::move(mesh);
  return made;
}

}  // namespace

std::span<const Index> BodyModel::faces_of(Index vertex) const { return surface->triangles_at(vertex); }

std::shared_ptr<BodyModel> make_body_mesh(Mesh mesh) {
  auto p = std::make_shared<BodyModel>();
  static_cast<BodyMesh&>(*p) = body_mesh(std::move(mesh));
  for (Index vertex = 0; vertex < p->mesh.vertices.size(); ++vertex) {
    const std::span<const Index> faces = p->faces_of(vertex);
    for (const Index f : faces) {
      const auto& [a, b, c] = p->mesh.triangles[f];
      p->opposite.push_back(vertex == a ? Edge{b, c} : vertex == b ? Edge{c, a} : Edge{a, b});
    }
    p->first_opposite.push_back(static_cast<Index>(p->opposite.size()));
    p->largest_degree = std::max(p->largest_degree, double(faces.size()));
  }
  p->rolls = nearly_closed(p->mesh);
  p->start = p->mesh.vertices;
  if (p->mesh.closed) p->start_volume = volume(p->start, p->mesh.triangles);
  return p;
}

std::shared_ptr<BodyModel> make_body_mesh(const MeshSource& source) {
  auto p = make_body_mesh(source.make());
  if (source.imported && source.imported->coarse)
    p->fine = std::make_shared<const FineMesh>(FineMesh{body_mesh(source.imported->mesh), source.imported});
  return p;
}

}  // namespace softbody
