#include "collide/surface_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace collide {
namespace {

glm::vec3 below(const glm::vec3& v) { return glm::min(v, glm::vec3(0.0f)); }
glm::vec3 above(const glm::vec3& v) { return glm::max(v, glm::vec3(0.0f)); }

/// Grows every box of a list by what `lo` and `hi` add to its corners.
void grow(BoxList& list, const glm::vec3& lo, const glm::vec3& hi) {
  for (int axis = 0; axis < 3; ++axis)
    for (Index k = 0; k < list.size; ++k) {
      list.lo[static_cast<std::size_t>(axis)][k] += lo[axis];
      list.hi[static_cast<std::size_t>(axis)][k] += hi[axis];
    }
}

/// The boxes around features, given those of their vertices.
template <std::size_t corners>
void join(const BoxList& vertices, const std::vector<std::array<Index, corners>>& features, BoxList& list) {
  list.clear();
  list.reserve(static_cast<Index>(features.size()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto &lo = vertices.lo[axis], &hi = vertices.hi[axis];
    for (std::size_t i = 0; i < features.size(); ++i) {
      float least = lo[features[i][0]], most = hi[features[i][0]];
      for (std::size_t k = 1; k < corners; ++k) {
        least = std::min(least, lo[features[i][k]]);
        most = std::max(most, hi[features[i][k]]);
      }
      list.lo[axis][i] = least;
      list.hi[axis][i] = most;
    }
  }
  for (Index i = 0; i < features.size(); ++i) list.item[i] = i;
  list.size = static_cast<Index>(features.size());
  list.end();
}

template <std::size_t n, std::size_t m>
bool share_vertex(const std::array<Index, n>& a, const std::array<Index, m>& b) {
  return std::any_of(a.begin(), a.end(), [&](Index v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

}  // namespace

Run SurfaceSearch::run(Index body) const {
  const Frame& f = motion_.positions;
  const Index first = f.bodies->first[body];
  return {f.x.data() + first, f.y.data() + first, f.z.data() + first, f.bodies->size(body)};
}

float SurfaceSearch::speed(const SurfacePair& pair) const {
  const Swept &a = swept_[pair.a], &b = swept_[pair.b];
  if (pair.a == pair.b) return 2 * a.strain / seconds_;
  return glm::length(a.velocity - b.velocity) + (a.spread + b.spread) / seconds_;
}

void SurfaceSearch::clear() {
  pairs_.clear();
  features_.clear();
  unfolded_ = 0;
}

void SurfaceSearch::recall(std::vector<FeaturePair> features, std::span<const float> strays) {
  clear();
  features_ = std::move(features);
  swept_.assign(strays.size(), {});
  for (std::size_t body = 0; body < strays.size(); ++body) swept_[body].stray = strays[body];
}

void SurfaceSearch::sweep_body(Index body) {
  Swept& s = swept_[body];
  const Index count = motion_.positions.bodies->size(body);
  const SurfaceBody& traits = bodies_[body];
  s.live = false;
  if (count == 0 || !traits.surface) return;
  const Run at = run(body);
  s.velocity = glm::vec3(0.0f);
  if (traits.moves) {
    for (Index v = 0; v < count; ++v) s.velocity += velocity(body, v);
    s.velocity = s.velocity / static_cast<float>(count);
  }
  glm::vec3 momentum(0.0f), centre(0.0f);
  s.stray = 0;
  float inertia = 0;
  for (Index v = 0; v < count; ++v) centre += glm::vec3(at.x[v], at.y[v], at.z[v]) / static_cast<float>(count);
  s.centre = centre;
  const auto arm = [&](Index v) { return glm::vec3(at.x[v], at.y[v], at.z[v]) - centre; };
  for (Index v = 0; v < count && traits.moves; ++v) {
    momentum += glm::cross(arm(v), velocity(body, v) - s.velocity);
    inertia += glm::dot(arm(v), arm(v)) * (2.0f / 3);  // as if it were a ball: any spin will do
  }
  s.spin = inertia > 0 ? momentum / inertia : glm::vec3(0.0f);
  float strain2 = 0;
  s.vertices.clear();
  s.vertices.reserve(count);
  float farthest2 = 0;
  for (Index v = 0; v < count; ++v) {
    const glm::vec3 x(at.x[v], at.y[v], at.z[v]);
    const glm::vec3 move = traits.moves ? seconds_ * (velocity(body, v) - s.velocity) : glm::vec3(0.0f);
    const glm::vec3 strain = traits.moves ? move - seconds_ * glm::cross(s.spin, arm(v)) : glm::vec3(0.0f);
    farthest2 = std::max(farthest2, glm::dot(move, move));
    strain2 = std::max(strain2, glm::dot(strain, strain));
    s.vertices.add({x + below(move) - traits.skin, x + above(move) + traits.skin}, v);
  }
  s.vertices.end();
  s.spread = std::sqrt(farthest2);
  s.strain = std::sqrt(strain2);
  s.box = s.vertices.bounds();
  s.world = {s.box.lo + below(seconds_ * s.velocity), s.box.hi + above(seconds_ * s.velocity)};
  const glm::vec3 all = s.centre + s.velocity + (s.world.hi - s.world.lo);  // boxes alone do not show a NaN
  s.live = std::isfinite(all.x + all.y + all.z + s.spread);
}

void SurfaceSearch::find_near() {
  order_.clear();
  near_.clear();
  for (Index b = 0; b < swept_.size(); ++b)
    if (swept_[b].live) order_.push_back(b);
  sweep(
      order_, 0.0f, [&](Index b) -> const Aabb& { return swept_[b].world; },
      [&](Index a, Index b) {
        if (bodies_[a].moves || bodies_[b].moves) near_.push_back({std::min(a, b), std::max(a, b)});
      });
}

void SurfaceSearch::find(const Motion& motion, std::span<const SurfaceBody> bodies, float seconds, bool self,
                         Workers& workers) {
  motion_ = motion;
  bodies_ = bodies;
  seconds_ = seconds;
  start_ = {std::vector(motion.positions.x.begin(), motion.positions.x.end()),
            std::vector(motion.positions.y.begin(), motion.positions.y.end()),
            std::vector(motion.positions.z.begin(), motion.positions.z.end())};
  velocity_ = {std::vector(motion.vx.begin(), motion.vx.end()), std::vector(motion.vy.begin(), motion.vy.end()),
               std::vector(motion.vz.begin(), motion.vz.end())};
  clear();
  swept_.resize(bodies.size());
  threads_.resize(static_cast<std::size_t>(workers.threads()));
  const auto in_parts = [&](std::size_t count, const auto& task) {
    workers.run([&](int thread) {
      const Part part = part_of(count, thread, workers.threads());
      for (std::size_t i = part.begin; i < part.end; ++i) task(threads_[static_cast<std::size_t>(thread)], i);
    });
  };
  in_parts(bodies.size(), [&](Thread&, std::size_t b) { sweep_body(static_cast<Index>(b)); });
  find_near();
  if (self)
    for (Index b = 0; b < swept_.size(); ++b)
      if (swept_[b].live && bodies[b].moves) near_.push_back({b, b});
  std::sort(near_.begin(), near_.end());
  needed_.assign(bodies.size(), false);
  for (const auto& [a, b] : near_) needed_[a] = needed_[b] = true;
  in_parts(bodies.size(), [&](Thread&, std::size_t b) {
    if (!needed_[b]) return;
    join(swept_[b].vertices, bodies[b].surface->triangles(), swept_[b].faces);
    join(swept_[b].vertices, bodies[b].surface->edges(), swept_[b].edges);
  });
  for (Thread& t : threads_) t.pairs.clear(), t.features.clear(), t.unfolded = 0;
  in_parts(near_.size(), [&](Thread& own, std::size_t i) {
    const auto& [a, b] = near_[i];
    const std::size_t before = own.features.size();
    SurfacePair& pair = own.pairs.emplace_back();
    pair.a = a, pair.b = b;
    if (a == b)
      find_self(own, pair);
    else
      find_pair(own, pair);
    pair.end = static_cast<std::uint32_t>(own.features.size());
    if (own.features.size() == before) own.pairs.pop_back();
    if (own.features.size() > most_features)
      throw std::length_error("more than " + std::to_string(most_features) + " surface features are near each other");
  });
  gather();
}

/// One thread's pairs after another's.
void SurfaceSearch::gather() {
  for (const Thread& t : threads_) {
    const auto before = static_cast<std::uint32_t>(features_.size());
    if (features_.size() + t.features.size() > most_features)
      throw std::length_error("more than " + std::to_string(most_features) + " surface features are near each other");
    for (SurfacePair p : t.pairs) {
      for (std::uint32_t SurfacePair::*place :
           {&SurfacePair::vertex_face, &SurfacePair::face_vertex, &SurfacePair::edge_edge, &SurfacePair::end})
        p.*place += before;
      pairs_.push_back(p);
    }
    features_.insert(features_.end(), t.features.begin(), t.features.end());
    unfolded_ += t.unfolded;
  }
}

void SurfaceSearch::find_pair(Thread& own, SurfacePair& pair) {
  const Swept &a = swept_[pair.a], &b = swept_[pair.b];
  const glm::vec3 drift = seconds_ * (a.velocity - b.velocity), lo = below(drift), hi = above(drift);
  const auto range = [&] { return static_cast<std::uint32_t>(own.features.size()); };
  pair.vertex_face = pair.face_vertex = pair.edge_edge = range();
  // Seen from b, the boxes of a grow by its drift: instead of those, the box that they are compared with grows at
  // first.
  own.search.pick(a.faces, {b.box.lo - hi, b.box.hi - lo}, own.faces_a);
  if (own.faces_a.size == 0) return;
  grow(own.faces_a, lo, hi);
  const Aabb near_a = own.faces_a.bounds();
  own.search.pick(b.faces, near_a, own.faces_b);
  if (own.faces_b.size == 0) return;
  const Aabb near_b = own.faces_b.bounds(), before_drift{near_b.lo - hi, near_b.hi - lo};
  own.search.pick(b.vertices, near_a, own.vertices_b);
  own.search.pick(b.edges, near_a, own.edges_b);
  own.search.pick(a.vertices, before_drift, own.vertices_a);
  own.search.pick(a.edges, before_drift, own.edges_a);
  grow(own.vertices_a, lo, hi);
  grow(own.edges_a, lo, hi);
  const Surface &sa = *bodies_[pair.a].surface, &sb = *bodies_[pair.b].surface;
  own.search.between(own.vertices_a, own.faces_b, own.found);
  keep(own, pair, [&](const ItemPair& f) { return vertex_face(pair.a, f.a, pair.b, sb.triangles()[f.b]); });
  pair.face_vertex = range();
  own.search.between(own.vertices_b, own.faces_a, own.found);
  keep(own, pair, [&](const ItemPair& f) { return vertex_face(pair.b, f.a, pair.a, sa.triangles()[f.b]); });
  pair.edge_edge = range();
  own.search.between(own.edges_a, own.edges_b, own.found);
  keep(own, pair, [&](const ItemPair& f) { return edge_edge(pair.a, sa.edges()[f.a], pair.b, sb.edges()[f.b]); });
}

SurfaceSearch::Meeting SurfaceSearch::vertex_face(Index a, Index vertex, Index b, const Triangle& face) const {
  const auto& [i, j, k] = face;
  const Closest c = closest_vertex_face(at(a, vertex), at(b, i), at(b, j), at(b, k));
  return {glm::dot(c.apart, c.apart), fastest(a, std::array{vertex}, b, face)};
}

SurfaceSearch::Meeting SurfaceSearch::edge_edge(Index a, const Edge& one, Index b, const Edge& two) const {
  const Closest c = closest_edges(at(a, one[0]), at(a, one[1]), at(b, two[0]), at(b, two[1]));
  return {glm::dot(c.apart, c.apart), fastest(a, one, b, two)};
}

glm::vec3 SurfaceSearch::at(Index body, Index v) const {
  const Frame& f = motion_.positions;
  const Index i = f.bodies->first[body] + v;
  return {f.x[i], f.y[i], f.z[i]};
}

glm::vec3 SurfaceSearch::velocity(Index body, Index v) const {
  if (!bodies_[body].moves) return glm::vec3(0.0f);
  const Index i = motion_.positions.bodies->first[body] + v;
  return {motion_.vx[i], motion_.vy[i], motion_.vz[i]};
}

/// What is left of a vertex's velocity without the body's rigid motion.
glm::vec3 SurfaceSearch::strain_velocity(Index body, Index v) const {
  const Swept& s = swept_[body];
  return velocity(body, v) - s.velocity - glm::cross(s.spin, at(body, v) - s.centre);
}

/// The squared relative speed of two features' corners, the greatest; within a body, of what is not its rigid motion.
template <std::size_t n, std::size_t m>
float SurfaceSearch::fastest(Index a, const std::array<Index, n>& one, Index b, const std::array<Index, m>& two) const {
  float most = 0;
  for (const Index v : one)
    for (const Index w : two) {
      const glm::vec3 u = a == b ? strain_velocity(a, v) - strain_velocity(a, w) : velocity(a, v) - velocity(b, w);
      most = std::max(most, glm::dot(u, u));
    }
  return most;
}

/// Keeps those found that can come within reach in time.
template <class Meet>
void SurfaceSearch::keep(Thread& own, const SurfacePair& pair, const Meet& meet) {
  const SurfaceBody &a = bodies_[pair.a], &b = bodies_[pair.b];
  const float near = 1.1f * (a.skin - a.slack + b.skin - b.slack) + a.slack + b.slack;
  for (const ItemPair& f : own.found) {
    const Meeting m = meet(f);
    const float reach = near + seconds_ * std::sqrt(m.speed2);
    if (m.distance2 > reach * reach) continue;
    const float way = std::sqrt(m.distance2) - near;
    own.features.push_back({f.a, f.b, way > 0 ? way / std::sqrt(m.speed2) : 0.0f});
  }
  own.found.clear();
}

/// Whether a closed body is star-shaped, seen from its middle, and stays so for the motion at hand: then it cannot
/// touch itself. Every face must turn its outside away from the middle: det(a, b, c) > 0 for its corners. Then the way
/// out from the middle meets the surface the same number of times in every direction, and once is asked for. A motion
/// of at most m a corner takes no more than m (|a x b| + |b x c| + |c x a|) + m^2 (|a| + |b| + |c|) + m^3 from a
/// determinant.
bool SurfaceSearch::star_shaped(Index body) const {
  const Surface& surface = *bodies_[body].surface;
  if (!surface.closed()) return false;
  const Run at = run(body);
  const float m = swept_[body].strain + bodies_[body].slack;
  int met = 0;
  for (const auto& [i, j, k] : surface.triangles()) {
    const glm::vec3 &o = swept_[body].centre, a = glm::vec3(at.x[i], at.y[i], at.z[i]) - o,
                    b = glm::vec3(at.x[j], at.y[j], at.z[j]) - o, c = glm::vec3(at.x[k], at.y[k], at.z[k]) - o;
    const glm::vec3 ab = glm::cross(a, b), bc = glm::cross(b, c), ca = glm::cross(c, a);
    const float lost = m * (glm::length(ab) + glm::length(bc) + glm::length(ca)) +
                       m * m * (glm::length(a) + glm::length(b) + glm::length(c)) + m * m * m;
    if (!(glm::dot(a, bc) > lost)) return false;
    met += ab.y > 0 && bc.y > 0 && ca.y > 0;  // by the way up
  }
  return met == 1;
}

void SurfaceSearch::find_self(Thread& own, SurfacePair& pair) {
  const auto range = [&] { return static_cast<std::uint32_t>(own.features.size()); };
  pair.vertex_face = pair.face_vertex = pair.edge_edge = range();
  if (star_shaped(pair.a)) {
    ++own.unfolded;
    return;
  }
  const Surface& surface = *bodies_[pair.a].surface;
  const Run x = run(pair.a);
  own.vertices.clear();
  own.vertices.reserve(x.size);
  const float turn = seconds_ * glm::length(swept_[pair.a].spin);
  for (Index v = 0; v < x.size; ++v) {
    const glm::vec3 s = seconds_ * strain_velocity(pair.a, v);
    const float grown = bodies_[pair.a].skin + turn * glm::length(s);
    own.vertices.add({at(pair.a, v) + below(s) - grown, at(pair.a, v) + above(s) + grown}, v);
  }
  own.vertices.end();
  join(own.vertices, surface.triangles(), own.faces);
  join(own.vertices, surface.edges(), own.edges);
  own.search.between(own.vertices, own.faces, own.found);
  std::erase_if(own.found, [&](const ItemPair& f) { return share_vertex(std::array{f.a}, surface.triangles()[f.b]); });
  keep(own, pair, [&](const ItemPair& f) { return vertex_face(pair.a, f.a, pair.a, surface.triangles()[f.b]); });
  pair.face_vertex = pair.edge_edge = range();
  own.search.within(own.edges, own.found);
  std::erase_if(own.found, [&](const ItemPair& f) { return share_vertex(surface.edges()[f.a], surface.edges()[f.b]); });
  keep(own, pair,
       [&](const ItemPair& f) { return edge_edge(pair.a, surface.edges()[f.a], pair.a, surface.edges()[f.b]); });
}

bool SurfaceSearch::holds(const Frame& now, float elapsed) {
  bool all = true;
  for (Index body = 0; body < swept_.size(); ++body) {
    Swept& s = swept_[body];
    if (!s.live || !bodies_[body].moves) continue;
    const Index first = now.bodies->first[body], count = now.bodies->size(body);
    float strayed2 = 0;
    for (Index v = first; v < first + count; ++v) {
      const glm::vec3 stray(now.x[v] - (start_[0][v] + elapsed * velocity_[0][v]),
                            now.y[v] - (start_[1][v] + elapsed * velocity_[1][v]),
                            now.z[v] - (start_[2][v] + elapsed * velocity_[2][v]));
      strayed2 = std::max(strayed2, glm::dot(stray, stray));
    }
    s.stray = std::max(s.stray, std::sqrt(strayed2));
    all = all && s.stray <= bodies_[body].slack;
  }
  return all;
}

}  // namespace collide
