// Finds the vertices and edges that passed through faces and edges between two frames.

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "collide/oracle/moving_features.h"
#include "collide/oracle/surface_bodies.h"
#include "collide/oracle/surface_oracle.h"

namespace collide::oracle {

namespace {

/// Builds swept boxes in a frame of reference that moves with a body. In this frame, the boxes are small even if a body
/// moves fast, or two bodies move fast together.
struct MovingReference {
  glm::dvec3 drift{0};  // m, per step

  /// Extends the box by the path of a vertex. Only its end is rounded, by less than the margin.
  void add(surface::Box& box, const MovingPoint& point) const {
    const glm::dvec3 end = point.to - drift, margin = glm::abs(end) * 0x1p-52;
    box.add(point.from);
    box.add(end - margin);
    box.add(end + margin);
  }
};

class CrossingSearch {
 public:
  CrossingSearch(const Frame& before, const Frame& after, const surface::Surfaces& surfaces)
      : before_(before), after_(after), surfaces_(surfaces), moving_(surfaces.size()) {
    require_match(before, surfaces);
    require_match(after, surfaces);
    if (before.bodies->first != after.bodies->first)
      throw std::invalid_argument("frames: both must have the same bodies");
    std::vector<surface::Box> boxes;
    for (Index body = 0; body < surfaces.size(); ++body) {
      const surface::Box from = box_of_body(before, body), to = box_of_body(after, body);
      boxes.emplace_back();
      if (from.empty() || to.empty()) continue;
      boxes.back().add(from);
      boxes.back().add(to);
    }
    bodies_ = BodyNeighbours(std::move(boxes));
  }

  /// Builds the trees of a body. Call it for all bodies before find(). Threads may prepare different bodies at once.
  void prepare(Index body) {
    if (bodies_.box(body).empty() || !surfaces_[body]) return;
    Moving& own = moving_[body];
    own.reference.drift = mean_displacement(body);
    own.faces = surface::BoxTree(boxes_of(body, surfaces_[body]->triangles()));
    own.edges = surface::BoxTree(boxes_of(body, surfaces_[body]->edges()));
  }

  /// Appends all crossings of the body's vertices, and those of its edges with edges of itself and of later bodies.
  void find(Index body, std::vector<Crossing>& crossings) const {
    bodies_.for_each(body, [&](Index other) {
      if (!surfaces_[other]) return;
      find_vertices(body, other, crossings);
      if (body <= other && surfaces_[body]) find_edges(body, other, crossings);
    });
  }

 private:
  struct Moving {
    MovingReference reference;
    surface::BoxTree faces, edges;
  };

  MovingPoint point(Index vertex) const {
    return {glm::dvec3(position(before_, vertex)), glm::dvec3(position(after_, vertex))};
  }

  glm::dvec3 mean_displacement(Index body) const {
    glm::dvec3 sum(0);
    const Bodies& bodies = *before_.bodies;
    for (Index v = bodies.first[body]; v < bodies.first[body + 1]; ++v) {
      const MovingPoint p = point(v);
      sum += p.to - p.from;
    }
    return sum / static_cast<double>(bodies.size(body));
  }

  template <std::size_t N>
  surface::Box box_of(const std::array<Index, N>& vertices, const MovingReference& reference) const {
    surface::Box box;
    for (const Index vertex : vertices) reference.add(box, point(vertex));
    return box;
  }
  template <class Feature>
  std::vector<surface::Box> boxes_of(Index body, const std::vector<Feature>& features) const {
    std::vector<surface::Box> boxes;
    boxes.reserve(features.size());
    for (const Feature& feature : features) {
      boxes.push_back(box_of(to_frame(before_, body, feature), moving_[body].reference));
    }
    return boxes;
  }

  void find_vertices(Index body, Index other, std::vector<Crossing>& found) const {
    const Moving& against = moving_[other];
    for (Index v = before_.bodies->first[body]; v < before_.bodies->first[body + 1]; ++v) {
      against.faces.for_each_overlapping(box_of(std::array{v}, against.reference), [&](Index t) {
        const surface::Triangle face = to_frame(before_, other, surfaces_[other]->triangles()[t]);
        if (std::find(face.begin(), face.end(), v) != face.end()) return;
        const auto passage = vertex_through_face(point(v), point(face[0]), point(face[1]), point(face[2]));
        if (!passage) return;
        found.push_back({Crossing::Kind::vertex_face, body, other, {v, v}, face, passage->time, passage->inward});
      });
    }
  }

  void find_edges(Index body, Index other, std::vector<Crossing>& found) const {
    const Moving& against = moving_[other];
    const std::vector<surface::Edge>& others = surfaces_[other]->edges();
    for (Index e = 0; e < surfaces_[body]->edges().size(); ++e) {
      const surface::Edge edge = to_frame(before_, body, surfaces_[body]->edges()[e]);
      against.edges.for_each_overlapping(box_of(edge, against.reference), [&](Index k) {
        if (body == other && k <= e) return;
        const surface::Edge through = to_frame(before_, other, others[k]);
        if (edge[0] == through[0] || edge[0] == through[1] || edge[1] == through[0] || edge[1] == through[1]) return;
        const auto passage = edge_through_edge(point(edge[0]), point(edge[1]), point(through[0]), point(through[1]));
        if (!passage) return;
        found.push_back({Crossing::Kind::edge_edge,
                         body,
                         other,
                         edge,
                         {through[0], through[1], through[1]},
                         passage->time,
                         passage->inward});
      });
    }
  }

  Frame before_, after_;
  const surface::Surfaces& surfaces_;
  BodyNeighbours bodies_;
  std::vector<Moving> moving_;  // of each body
};

}  // namespace

std::vector<Crossing> find_crossings(const Frame& before, const Frame& after, const surface::Surfaces& surfaces,
                                     Workers& workers) {
  CrossingSearch search(before, after, surfaces);
  std::vector<std::vector<Crossing>> found(static_cast<std::size_t>(workers.threads()));
  workers.run([&](int thread) {
    const auto first = static_cast<Index>(thread), step = static_cast<Index>(workers.threads());
    for (Index body = first; body < surfaces.size(); body += step) search.prepare(body);
    workers.barrier();
    for (Index body = first; body < surfaces.size(); body += step) {
      search.find(body, found[static_cast<std::size_t>(thread)]);
    }
  });
  std::vector<Crossing> all;
  for (const std::vector<Crossing>& part : found) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.kind, a.feature, a.against) < std::tie(b.kind, b.feature, b.against);
  });
  return all;
}

}  // namespace collide::oracle
