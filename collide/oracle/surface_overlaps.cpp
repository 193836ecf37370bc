// Finds the vertices inside bodies and the edges through faces, at one instant.

#include <cmath>
#include <tuple>

#include <glm/geometric.hpp>

#include "collide/oracle/exact_predicates.h"
#include "collide/oracle/surface_bodies.h"
#include "collide/oracle/surface_oracle.h"

namespace collide::oracle {

namespace {

using Corners = std::array<glm::vec3, 3>;

/// Returns the point of a triangle that is nearest to p. Ericson, Real-Time Collision Detection (2005), §5.1.5: p lies
/// in the Voronoi region of a corner, of a side or of the face.
glm::dvec3 nearest_point(const glm::dvec3& p, const Corners& corners) {
  const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
  const glm::dvec3 ab = b - a, ac = c - a;
  const double d1 = glm::dot(ab, p - a), d2 = glm::dot(ac, p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = glm::dot(ab, p - b), d4 = glm::dot(ac, p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double d5 = glm::dot(ab, p - c), d6 = glm::dot(ac, p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double in_c = d1 * d4 - d3 * d2, in_b = d5 * d2 - d1 * d6, in_a = d3 * d6 - d5 * d4;
  if (in_c <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  if (in_b <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  if (in_a <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  return a + ab * (in_b / (in_a + in_b + in_c)) + ac * (in_c / (in_a + in_b + in_c));
}

class OverlapSearch {
 public:
  OverlapSearch(const Frame& frame, const surface::Surfaces& surfaces, bool depths)
      : frame_(frame), surfaces_(surfaces), depths_(depths) {
    require_match(frame, surfaces);
    for (Index body = 0; body < frame.bodies->count(); ++body) boxes_.push_back(box_of_body(frame, body));
    bodies_ = surface::BoxTree(boxes_);
    faces_.resize(surfaces.size());
  }

  /// Builds the tree of a body. Call it for all bodies before find(). Threads may prepare different bodies at once.
  void prepare(Index body) {
    std::vector<surface::Box> boxes(surfaces_[body] ? surfaces_[body]->triangles().size() : 0);
    for (Index t = 0; t < boxes.size(); ++t) {
      for (const glm::vec3& corner : corners(body, t)) boxes[t].add(glm::dvec3(corner));
    }
    if (!boxes_[body].empty()) faces_[body] = surface::BoxTree(boxes);
  }

  /// Appends the penetrations of the body's vertices, and the piercings of its edges, into all surfaces near it. Edges
  /// may pierce its own surface.
  void find(Index body, Overlaps& overlaps) const {
    bodies_.for_each_overlapping(boxes_[body], [&](Index other) {
      if (!surfaces_[other]) return;
      if (other != body && surfaces_[other]->closed()) find_vertices(body, other, overlaps.penetrations);
      if (surfaces_[body]) find_edges(body, other, overlaps.piercings);
    });
  }

 private:
  Corners corners(Index body, Index triangle) const {
    const auto [a, b, c] = to_frame(frame_, body, surfaces_[body]->triangles()[triangle]);
    return {position(frame_, a), position(frame_, b), position(frame_, c)};
  }

  void find_vertices(Index body, Index other, std::vector<Penetration>& found) const {
    const surface::Box& box = boxes_[other];
    for (Index v = frame_.bodies->first[body]; v < frame_.bodies->first[body + 1]; ++v) {
      const glm::vec3 p = position(frame_, v);
      if (overlap(box, point_box(p)) && inside(p, other))
        found.push_back(depths_ ? penetration(v, other) : Penetration{v, other, 0, 0, {}, {}});
    }
  }

  static surface::Box point_box(const glm::vec3& p) { return {glm::dvec3(p), glm::dvec3(p)}; }

  bool inside(const glm::vec3& p, Index body) const {
    surface::Box ray = point_box(p);
    ray.hi.x = std::numeric_limits<double>::infinity();
    int windings = 0;
    faces_[body].for_each_overlapping(ray, [&](Index t) {
      const auto [a, b, c] = corners(body, t);
      windings += ray_crossing(p, a, b, c);
    });
    if (windings == 0) return false;
    bool on_surface = false;
    faces_[body].for_each_overlapping(point_box(p), [&](Index t) {
      const auto [a, b, c] = corners(body, t);
      on_surface = on_surface || on_triangle(p, a, b, c);
    });
    return !on_surface;
  }

  Penetration penetration(Index vertex, Index body) const {
    const glm::dvec3 p(position(frame_, vertex));
    Penetration nearest{vertex, body, 0, 0, {}, {}};
    double smallest = std::numeric_limits<double>::infinity();
    faces_[body].walk([&](const surface::Box& box) { return squared_distance_to(box, p) <= smallest; },
                      [&](Index t) {
                        const glm::dvec3 q = nearest_point(p, corners(body, t));
                        const double squared = glm::dot(q - p, q - p);
                        const bool nearer = squared < smallest || (squared == smallest && t < nearest.triangle);
                        if (!nearer) return;  // also for NaN, from a triangle without area: others share its sides
                        smallest = squared;
                        nearest.triangle = t;
                        nearest.point = q;
                      });
    nearest.depth = std::sqrt(smallest);
    nearest.normal = nearest.depth > 0 ? (nearest.point - p) / nearest.depth : normal(body, nearest.triangle);
    return nearest;
  }

  glm::dvec3 normal(Index body, Index triangle) const {
    const auto [a, b, c] = corners(body, triangle);
    return glm::normalize(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)));
  }

  void find_edges(Index body, Index other, std::vector<Piercing>& found) const {
    for (const surface::Edge& local : surfaces_[body]->edges()) {
      const surface::Edge edge = to_frame(frame_, body, local);
      const glm::vec3 p = position(frame_, edge[0]), q = position(frame_, edge[1]);
      surface::Box box = point_box(p);
      box.add(glm::dvec3(q));
      if (!overlap(box, boxes_[other])) continue;
      faces_[other].for_each_overlapping(box, [&](Index t) {
        if (body == other && share_vertex(local, surfaces_[body]->triangles()[t])) return;
        if (passes(p, q, other, t)) found.push_back({edge, body, other, t, meeting_point(p, q, corners(other, t))});
      });
    }
  }

  static bool share_vertex(const surface::Edge& edge, const surface::Triangle& triangle) {
    return std::any_of(triangle.begin(), triangle.end(), [&](Index v) { return v == edge[0] || v == edge[1]; });
  }

  /// Returns true if the segment pq passes through the triangle. If it meets a side or a corner, its crossings of all
  /// faces around that side or corner are summed, with p moved slightly in two opposite directions. It passes through
  /// the surface if both sums are equal and have the sign of its crossing of this triangle. So it does not pass where
  /// it grazes a ridge (both sums are 0) or a border, or leaves within the plane of a face (one sum is 0).
  bool passes(const glm::vec3& p, const glm::vec3& q, Index body, Index triangle) const {
    const auto crossing_of = [&](Index t) {
      const auto [a, b, c] = corners(body, t);
      return segment_crossing(p, q, a, b, c);
    };
    const SegmentCrossing crossing = crossing_of(triangle);
    if (crossing.plus == crossing.minus) return crossing.plus != 0;
    if (crossing.plus == 0) return false;  // if there is a passage, another face around reports it

    const std::vector<Index> common = met_vertices(surfaces_[body]->triangles()[triangle], crossing.meets);
    int plus = 0, minus = 0;
    for (const Index t : surfaces_[body]->triangles_at(common[0])) {
      const surface::Triangle& other = surfaces_[body]->triangles()[t];
      if (std::find(other.begin(), other.end(), common.back()) == other.end()) continue;
      const SegmentCrossing neighbour = crossing_of(t);
      plus += neighbour.plus;
      minus += neighbour.minus;
    }
    return plus == minus && plus * crossing.plus > 0;
  }

  /// Returns the two ends of the side that is met, or the one corner if two sides are met.
  static std::vector<Index> met_vertices(const surface::Triangle& triangle, const std::array<bool, 3>& meets) {
    if (meets[0] && meets[1]) return {triangle[1]};
    if (meets[1] && meets[2]) return {triangle[2]};
    if (meets[2] && meets[0]) return {triangle[0]};
    const std::size_t k = meets[0] ? 0 : meets[1] ? 1 : 2;
    return {triangle[k], triangle[(k + 1) % 3]};
  }

  static glm::dvec3 meeting_point(const glm::vec3& from, const glm::vec3& to, const Corners& corners) {
    const glm::dvec3 p(from), q(to), a(corners[0]);
    const glm::dvec3 n = glm::cross(glm::dvec3(corners[1]) - a, glm::dvec3(corners[2]) - a);
    const double before = glm::dot(n, p - a), after = glm::dot(n, q - a);
    const double t = before != after ? glm::clamp(before / (before - after), 0.0, 1.0) : 0.5;
    return p + (q - p) * t;
  }

  Frame frame_;
  const surface::Surfaces& surfaces_;
  bool depths_;
  std::vector<surface::Box> boxes_;  // of each body; empty: it takes no part
  surface::BoxTree bodies_;
  std::vector<surface::BoxTree> faces_;  // of each body
};

}  // namespace

Overlaps find_overlaps(const Frame& frame, const surface::Surfaces& surfaces, Workers& workers, bool depths) {
  OverlapSearch search(frame, surfaces, depths);
  constexpr double vertex_ns = 500;  // of work
  const int threads = workers.threads_for(vertex_ns * static_cast<double>(frame.x.size()));
  std::vector<Overlaps> found(static_cast<std::size_t>(threads));
  workers.share(threads, surfaces.size(), [&](int, std::size_t body) { search.prepare(static_cast<Index>(body)); });
  workers.share(threads, surfaces.size(), [&](int thread, std::size_t body) {
    search.find(static_cast<Index>(body), found[static_cast<std::size_t>(thread)]);
  });
  Overlaps all;
  for (const Overlaps& part : found) {
    all.penetrations.insert(all.penetrations.end(), part.penetrations.begin(), part.penetrations.end());
    all.piercings.insert(all.piercings.end(), part.piercings.begin(), part.piercings.end());
  }
  std::sort(all.penetrations.begin(), all.penetrations.end(), [](const Penetration& a, const Penetration& b) {
    return std::tie(a.vertex, a.body) < std::tie(b.vertex, b.body);
  });
  std::sort(all.piercings.begin(), all.piercings.end(), [](const Piercing& a, const Piercing& b) {
    return std::tie(a.edge, a.triangle_body, a.triangle) < std::tie(b.edge, b.triangle_body, b.triangle);
  });
  return all;
}

}  // namespace collide::oracle
