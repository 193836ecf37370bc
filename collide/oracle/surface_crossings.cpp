// Finds the vertices and edges that passed through faces and edges between two frames.

#include <stdexcept>

#include "collide/oracle/surface_bodies.h"
#include "collide/oracle/surface_oracle.h"

namespace collide::oracle {

namespace {

/// Returns the motion of the bodies that are finite in both frames.
MovingMesh moving_mesh(const Frame& before, const Frame& after, const surface::Surfaces& surfaces) {
  MovingMesh mesh;
  const Bodies& bodies = *before.bodies;
  for (Index v = 0; v < bodies.vertex_count(); ++v)
    mesh.points.push_back({glm::dvec3(position(before, v)), glm::dvec3(position(after, v))});
  for (Index body = 0; body < bodies.count(); ++body) {
    mesh.body.resize(bodies.first[body + 1], body);
    if (box_of_body(before, body).empty() || box_of_body(after, body).empty()) continue;
    for (Index v = bodies.first[body]; v < bodies.first[body + 1]; ++v) mesh.vertices.push_back({v});
    if (!surfaces[body]) continue;
    for (const auto& edge : surfaces[body]->edges()) mesh.edges.push_back(to_frame(before, body, edge));
    for (const auto& face : surfaces[body]->triangles()) mesh.faces.push_back(to_frame(before, body, face));
  }
  return mesh;
}

}  // namespace

std::vector<Crossing> find_crossings(const Frame& before, const Frame& after, const surface::Surfaces& surfaces,
                                     Workers& workers) {
  require_match(before, surfaces);
  require_match(after, surfaces);
  if (before.bodies->first != after.bodies->first)
    throw std::invalid_argument("frames: both must have the same bodies");
  const MovingMesh mesh = moving_mesh(before, after, surfaces);
  std::vector<Crossing> crossings;
  search_pairs<Crossing>(
      mesh, workers,
      [&](const MovingPair& pair) -> std::optional<Crossing> {
        const std::optional<Passage> passage = passage_of(mesh, pair);
        if (!passage) return std::nullopt;
        return Crossing{pair, mesh.body[pair.feature[0]], mesh.body[pair.against[0]], passage->time, passage->inward};
      },
      [&](const std::vector<Crossing>& found) { crossings.insert(crossings.end(), found.begin(), found.end()); });
  return crossings;
}

}  // namespace collide::oracle
