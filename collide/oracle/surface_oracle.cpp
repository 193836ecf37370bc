#include "collide/oracle/surface_oracle.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "collide/oracle/surface_bodies.h"

namespace collide::oracle {

namespace {

template <class T>
void sort_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

OverlappingPair pair_of(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

/// Looks up contacts by their vertices, by vertex and body, and by bodies. contacts: ascending.
class ContactLookup {
 public:
  ContactLookup(std::span<const Contact> contacts, const Bodies& bodies) : contacts_(contacts) {
    for (const Contact& contact : contacts) {
      const Index a = bodies.body_of(contact.a), b = bodies.body_of(contact.b);
      bodies_.push_back({a, b});  // a <= b, since the vertices ascend
      vertex_and_body_.push_back({contact.a, b});
      vertex_and_body_.push_back({contact.b, a});
    }
    sort_unique(bodies_);
    sort_unique(vertex_and_body_);
  }
  bool joins(Index a, Index b) const {
    return std::binary_search(contacts_.begin(), contacts_.end(), Contact{std::min(a, b), std::max(a, b)});
  }
  bool joins_vertex_to_body(Index vertex, Index body) const {
    return std::binary_search(vertex_and_body_.begin(), vertex_and_body_.end(), std::array{vertex, body});
  }
  bool joins_bodies(const OverlappingPair& pair) const {
    return std::binary_search(bodies_.begin(), bodies_.end(), pair);
  }

 private:
  std::span<const Contact> contacts_;
  std::vector<OverlappingPair> bodies_;
  std::vector<std::array<Index, 2>> vertex_and_body_;  // a contact joins the vertex to a vertex of the body
};

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

std::vector<OverlappingPair> overlapping_pairs(const Frame& frame, const Overlaps& overlaps) {
  std::vector<OverlappingPair> pairs;
  for (const Penetration& in : overlaps.penetrations)
    pairs.push_back(pair_of(frame.bodies->body_of(in.vertex), in.body));
  for (const Piercing& through : overlaps.piercings) pairs.push_back(pair_of(through.edge_body, through.triangle_body));
  sort_unique(pairs);
  return pairs;
}

SurfaceFigures figures_of(const Frame& frame, const Overlaps& overlaps, std::span<const Crossing> crossings) {
  SurfaceFigures figures;
  for (const OverlappingPair& pair : overlapping_pairs(frame, overlaps)) {
    ++(pair.a == pair.b ? figures.self_intersecting_bodies : figures.overlapping_pairs);
  }
  figures.piercings = overlaps.piercings.size();
  std::vector<Index> inside, crossed;
  for (const Penetration& in : overlaps.penetrations) {
    inside.push_back(in.vertex);
    figures.deepest = std::max(figures.deepest, in.depth);
    figures.mean_depth += in.depth / static_cast<double>(overlaps.penetrations.size());
  }
  for (const Crossing& crossing : crossings) {
    if (crossing.kind == Crossing::Kind::vertex_face)
      crossed.push_back(crossing.feature[0]);
    else
      ++figures.edge_crossings;
  }
  sort_unique(inside);
  sort_unique(crossed);
  figures.penetrating_vertices = inside.size();
  figures.crossed_vertices = crossed.size();
  return figures;
}

Missed missed_by(std::span<const Contact> contacts, const Frame& frame, const surface::Surfaces& surfaces,
                 const Overlaps& overlaps) {
  assert(std::is_sorted(contacts.begin(), contacts.end()));
  const ContactLookup lookup(contacts, *frame.bodies);
  Missed missed;
  for (std::size_t i = 0; i < overlaps.penetrations.size(); ++i) {
    const Penetration& in = overlaps.penetrations[i];
    if (!lookup.joins_vertex_to_body(in.vertex, in.body)) missed.penetrations.push_back(i);
  }
  for (std::size_t i = 0; i < overlaps.piercings.size(); ++i) {
    const Piercing& through = overlaps.piercings[i];
    const surface::Triangle face =
        to_frame(frame, through.triangle_body, surfaces[through.triangle_body]->triangles()[through.triangle]);
    const bool joined = std::any_of(face.begin(), face.end(), [&](Index corner) {
      return lookup.joins(through.edge[0], corner) || lookup.joins(through.edge[1], corner);
    });
    if (!joined) missed.piercings.push_back(i);
  }
  for (const OverlappingPair& pair : overlapping_pairs(frame, overlaps)) {
    if (!lookup.joins_bodies(pair)) missed.pairs.push_back(pair);
  }
  return missed;
}

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
