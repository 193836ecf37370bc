#include "collide/surface/surface_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace collide::surface {
namespace {

/// Adds `lo` to the minimum corner and `hi` to the maximum corner of every box.
void grow(BoxList& list, const glm::vec3& lo, const glm::vec3& hi) {
  for (int axis = 0; axis < 3; ++axis)
    for (Index k = 0; k < list.size; ++k) {
      list.lo[static_cast<std::size_t>(axis)][k] += lo[axis];
      list.hi[static_cast<std::size_t>(axis)][k] += hi[axis];
    }
}

// Of the mean edge:
constexpr float self_margin = 0.1f;                          // see SelfNeighbours::cover()
constexpr float max_self_deformation = 0.25f;                // of a body that may touch itself, within one prediction
constexpr std::size_t max_box_pairs = std::size_t{1} << 26;  // of two bodies: 512 MiB for each thread

[[maybe_unused]] bool has_all_vertices(const Motion& motion) {
  const std::size_t count = motion.positions.x.size();
  return is_complete(motion.positions) && motion.vx.size() == count && motion.vy.size() == count &&
         motion.vz.size() == count;
}

/// Sorts what was appended to a list of features since it had `first`.
void sort_from(std::size_t first, std::vector<FeaturePair>& features) {
  const auto by_key = [](const FeaturePair& x, const FeaturePair& y) { return x.key() < y.key(); };
  std::sort(features.begin() + static_cast<std::ptrdiff_t>(first), features.end(), by_key);
}

/// Returns true if one body may be wholly inside the other; then no features need be near each other.
bool may_contain(const SweptBody& outer, const SweptBody& inner) {
  const Aabb &o = outer.world_box(), &i = inner.world_box();
  return outer.surface().closed() && glm::all(glm::lessThan(o.lo, i.lo)) && glm::all(glm::lessThan(i.hi, o.hi));
}

}  // namespace

float SurfaceSearch::max_relative_speed(const SurfacePair& pair) const {
  const SweptBody &a = swept_[pair.a], &b = swept_[pair.b];
  if (pair.a == pair.b) return 2 * a.max_deformation_speed();
  return glm::length(a.mean_velocity() - b.mean_velocity()) + a.velocity_spread() + b.velocity_spread();
}

void SurfaceSearch::clear() {
  for (Candidates* c : {&current_, &previous_}) c->pairs.clear(), c->features.clear();
}

void SurfaceSearch::restore(std::vector<FeaturePair> features, std::span<const History> history) {
  clear();
  current_.features = std::move(features);
  end_ = 0;
  swept_.resize(history.size());
  for (std::size_t body = 0; body < history.size(); ++body)
    swept_[body].restore(history[body].deviation, -history[body].duration);
}

bool SurfaceSearch::check_valid(const Frame& now, float elapsed, float ahead) {
  bool valid = true;
  for (Index body = 0; body < swept_.size(); ++body) {
    swept_[body].update_deviation(now, body, elapsed, std::min(elapsed + ahead, end_));
    valid = valid && !swept_[body].expired();
  }
  return valid;
}

float SurfaceSearch::holds_until() const {
  float until = predicted_until_;
  for (const SweptBody& body : swept_) until = std::min(until, body.holds_until());
  return until;
}

void SurfaceSearch::check_feature_limit(std::size_t features) const {
  if (features > query_.max_features)
    throw std::length_error("more than " + std::to_string(query_.max_features) +
                            " pairs of surface features are near each other: move bodies apart or remove some");
}

void SurfaceSearch::find(const Motion& motion, std::span<const SurfaceBody> bodies, const SurfaceQuery& query,
                         Workers& workers) {
  assert(has_all_vertices(motion) && bodies.size() <= motion.positions.bodies->count());
  bodies_ = bodies;
  query_ = query;
  time_ = 0, end_ = query.seconds;
  swept_.resize(bodies.size());
  near_itself_.resize(bodies.size());
  predicted_anew_.assign(bodies.size(), true);
  may_touch_itself_.assign(bodies.size(), false);
  has_boxes_.assign(bodies.size(), false);
  search(motion, query.min_seconds, workers);
}

void SurfaceSearch::update(const Motion& motion, std::span<const SurfaceBody> bodies, float elapsed, float min_seconds,
                           Workers& workers) {
  assert(has_all_vertices(motion) && bodies.size() == swept_.size());
  bodies_ = bodies;
  time_ = elapsed;
  for (Index b = 0; b < swept_.size(); ++b) {
    predicted_anew_[b] = swept_[b].expired();
    if (predicted_anew_[b]) has_boxes_[b] = false;
  }
  search(motion, min_seconds, workers);
}

void SurfaceSearch::search(const Motion& motion, float min_seconds, Workers& workers) {
  threads_.resize(static_cast<std::size_t>(workers.threads()));
  for (Thread& t : threads_) t.candidates.pairs.clear(), t.candidates.features.clear(), t.found.clear(), t.work = 0;
  const auto in_parts = [&](std::size_t count, const auto& task) {
    workers.run([&](int thread) {
      const Part part = part_of(count, thread, workers.threads());
      for (std::size_t i = part.begin; i < part.end; ++i) task(threads_[static_cast<std::size_t>(thread)], i);
    });
  };
  in_parts(swept_.size(), [&](Thread& own, std::size_t b) {
    const float end = std::min(end_, time_ + bodies_[b].horizon);
    if (!predicted_anew_[b]) return;
    SweptBody& body = swept_[b];
    body.predict(motion, static_cast<Index>(b), bodies_[b], time_, end, min_seconds);
    may_touch_itself_[b] = query_.self && body.live() && body.moves() && !body.stays_star_shaped();
    if (may_touch_itself_[b]) cover_itself(own, static_cast<Index>(b), min_seconds);
  });
  find_near_bodies();
  std::swap(current_, previous_);
  in_parts(swept_.size(), [&](Thread& own, std::size_t b) {
    if (!needs_boxes_[b] || has_boxes_[b]) return;
    swept_[b].build_feature_boxes();
    has_boxes_[b] = true;
    own.work += swept_[b].surface().feature_count();
  });
  in_parts(near_bodies_.size(), [&](Thread& own, std::size_t i) { find_candidates(own, near_bodies_[i]); });
  merge_threads();
  work_ = current_.features.size();
  for (const Thread& t : threads_) work_ += t.work;
}

/// Finds the pairs of bodies whose boxes overlap, and the bodies that may touch themselves. The broad phase.
void SurfaceSearch::find_near_bodies() {
  order_.clear();
  near_bodies_.clear();
  needs_boxes_.assign(swept_.size(), false);
  predicted_until_ = end_;
  for (Index b = 0; b < swept_.size(); ++b) {
    if (!swept_[b].live()) continue;
    order_.push_back(b);
    predicted_until_ = std::min(predicted_until_, swept_[b].end());
    if (!may_touch_itself_[b]) continue;
    for (const bool edges : {false, true}) near_bodies_.push_back({b, b, edges});
  }
  sweep(
      order_, 0.0f, [&](Index b) -> const Aabb& { return swept_[b].world_box(); },
      [&](Index a, Index b) {
        if (!swept_[a].moves() && !swept_[b].moves()) return;
        near_bodies_.push_back({std::min(a, b), std::max(a, b), false});
        if (predicted_anew_[a] || predicted_anew_[b]) needs_boxes_[a] = needs_boxes_[b] = true;
      });
  std::sort(near_bodies_.begin(), near_bodies_.end());
}

void SurfaceSearch::find_candidates(Thread& own, const NearBodies& bodies) {
  const auto begin = static_cast<std::uint32_t>(own.candidates.features.size());
  SurfacePair pair{bodies.a, bodies.b, begin, begin, begin, begin};
  if (!predicted_anew_[pair.a] && !predicted_anew_[pair.b])
    copy_previous(own, pair, bodies.edges);
  else if (pair.a == pair.b)
    find_within(own, pair, bodies.edges);
  else
    find_between(own, pair);
  pair.end = static_cast<std::uint32_t>(own.candidates.features.size());
  const SweptBody &a = swept_[pair.a], &b = swept_[pair.b];
  if (pair.end > begin || may_contain(a, b) || may_contain(b, a)) own.candidates.pairs.push_back(pair);
  check_feature_limit(own.candidates.features.size());
}

/// Copies the candidates of two bodies from the previous search; of a body with itself, see NearBodies.
void SurfaceSearch::copy_previous(Thread& own, SurfacePair& pair, bool edges) const {
  const auto old = std::lower_bound(previous_.pairs.begin(), previous_.pairs.end(), pair,
                                    [](const auto& x, const auto& y) { return x.bodies() < y.bodies(); });
  if (old == previous_.pairs.end() || old->bodies() != pair.bodies()) return;
  const std::uint32_t begin = edges ? old->edge_edge : old->vertex_face,
                      end = pair.a == pair.b && !edges ? old->edge_edge : old->end;
  const auto first = previous_.features.begin();
  own.candidates.features.insert(own.candidates.features.end(), first + begin, first + end);
  pair.face_vertex += old->face_vertex - begin;
  pair.edge_edge += old->edge_edge - begin;
}

/// Appends the candidates of one thread after another.
void SurfaceSearch::merge_threads() {
  current_.pairs.clear(), current_.features.clear();
  for (const Thread& t : threads_) {
    const auto base = static_cast<std::uint32_t>(current_.features.size());
    check_feature_limit(current_.features.size() + t.candidates.features.size());
    for (SurfacePair p : t.candidates.pairs) {
      for (std::uint32_t SurfacePair::*offset :
           {&SurfacePair::vertex_face, &SurfacePair::face_vertex, &SurfacePair::edge_edge, &SurfacePair::end})
        p.*offset += base;
      if (!current_.pairs.empty() && current_.pairs.back().bodies() == p.bodies())
        current_.pairs.back().end = p.end;  // of a body with itself: its edges
      else
        current_.pairs.push_back(p);
    }
    current_.features.insert(current_.features.end(), t.candidates.features.begin(), t.candidates.features.end());
  }
}

void SurfaceSearch::find_between(Thread& own, SurfacePair& pair) const {
  const SweptBody &a = swept_[pair.a], &b = swept_[pair.b];
  const float end = std::min(a.end(), b.end());
  const glm::vec3 first = a.drift(time_) - b.drift(time_), last = a.drift(end) - b.drift(end);
  const glm::vec3 lo = glm::min(first, last), hi = glm::max(first, last);
  const auto next = [&] { return static_cast<std::uint32_t>(own.candidates.features.size()); };
  // In the frame of b, the boxes of a grow by the relative drift. To select the boxes of a before they are grown, the
  // box that they are compared with grows the opposite way.
  own.search.pick(a.face_boxes(), {b.local_box().lo - hi, b.local_box().hi - lo}, own.faces_a);
  if (own.faces_a.size == 0) return;
  grow(own.faces_a, lo, hi);
  const Aabb near_a = own.faces_a.bounds();
  own.search.pick(b.face_boxes(), near_a, own.faces_b);
  if (own.faces_b.size == 0) return;
  const Aabb near_b = own.faces_b.bounds(), grown_near_b{near_b.lo - hi, near_b.hi - lo};
  own.search.pick(b.vertex_boxes(), near_a, own.vertices_b);
  own.search.pick(b.edge_boxes(), near_a, own.edges_b);
  own.search.pick(a.vertex_boxes(), grown_near_b, own.vertices_a);
  own.search.pick(a.edge_boxes(), grown_near_b, own.edges_a);
  grow(own.vertices_a, lo, hi);
  grow(own.edges_a, lo, hi);
  own.search.between(own.vertices_a, own.faces_b, own.found, max_box_pairs);
  own.work += own.found.size();
  add_vertex_faces(own, pair, pair.a, pair.b);
  pair.face_vertex = next();
  own.search.between(own.vertices_b, own.faces_a, own.found, max_box_pairs);
  own.work += own.found.size();
  add_vertex_faces(own, pair, pair.b, pair.a);
  pair.edge_edge = next();
  own.search.between(own.edges_a, own.edges_b, own.found, max_box_pairs);
  own.work += own.found.size();
  add_edges(own, pair);
}

/// Returns the largest squared relative speed (m^2/s^2) of the corners of two features; within a body, without its
/// rigid motion.
template <std::size_t n, std::size_t m>
float SurfaceSearch::max_squared_speed(Index a, const std::array<Index, n>& one, Index b,
                                       const std::array<Index, m>& two) const {
  float largest = 0;
  for (const Index v : one)
    for (const Index w : two) {
      const glm::vec3 u = a == b ? swept_[a].deformation_velocity(v) - swept_[a].deformation_velocity(w)
                                 : swept_[a].velocity(v) - swept_[b].velocity(w);
      largest = std::max(largest, glm::dot(u, u));
    }
  return largest;
}

void SurfaceSearch::add_vertex_faces(Thread& own, const SurfacePair& pair, Index a, Index b) const {
  const std::size_t first = own.candidates.features.size();
  const auto& faces = swept_[b].surface().triangles();
  for (std::size_t i = 0; i < own.found.size();) {
    own.batch.clear();
    for (; i < own.found.size() && !own.batch.full(); ++i) {
      const auto& [u, v, w] = faces[own.found[i].b];
      own.batch.add({at(a, own.found[i].a), at(b, u), at(b, v), at(b, w)}, static_cast<Index>(i));
    }
    own.batch.find_closest_vertex_faces();
    add_reachable(own, pair, [&](const ItemPair& f) { return max_squared_speed(a, std::array{f.a}, b, faces[f.b]); });
    check_feature_limit(own.candidates.features.size());
  }
  sort_from(first, own.candidates.features);
  own.found.clear();
}

void SurfaceSearch::add_edges(Thread& own, const SurfacePair& pair) const {
  const std::size_t first = own.candidates.features.size();
  const auto &ones = swept_[pair.a].surface().edges(), &twos = swept_[pair.b].surface().edges();
  for (std::size_t i = 0; i < own.found.size();) {
    own.batch.clear();
    for (; i < own.found.size() && !own.batch.full(); ++i) {
      const Edge &one = ones[own.found[i].a], &two = twos[own.found[i].b];
      own.batch.add({at(pair.a, one[0]), at(pair.a, one[1]), at(pair.b, two[0]), at(pair.b, two[1])},
                    static_cast<Index>(i));
    }
    own.batch.find_closest_edges();
    add_reachable(own, pair,
                  [&](const ItemPair& f) { return max_squared_speed(pair.a, ones[f.a], pair.b, twos[f.b]); });
    check_feature_limit(own.candidates.features.size());
  }
  sort_from(first, own.candidates.features);
  own.found.clear();
}

/// Returns the distance (m) from which features that move at `speed` relative to each other can come within 1.1 times
/// their contact distance before the prediction ends.
float SurfaceSearch::reach(const SurfacePair& pair, float speed) const {
  const SurfaceBody &a = bodies_[pair.a], &b = bodies_[pair.b];
  const float near = 1.1f * (a.skin - a.slack + b.skin - b.slack) + a.slack + b.slack;
  return near + (std::min(swept_[pair.a].end(), swept_[pair.b].end()) - time_) * speed;
}

/// Adds the pairs of the batch that can come within reach of each other before the prediction ends. Their
/// distance and relative speed bound the earliest time of that, as in conservative advancement.
/// squared_speed(features): m^2/s^2, of their corners.
template <class Speed>
void SurfaceSearch::add_reachable(Thread& own, const SurfacePair& pair, const Speed& squared_speed) const {
  const float near = reach(pair, 0), max_distance = reach(pair, max_relative_speed(pair)),
              max_distance2 = max_distance * max_distance;
  for (Index i = 0; i < own.batch.size(); ++i) {
    const float distance2 = own.batch.distance2(i);
    if (distance2 > max_distance2) continue;
    const ItemPair& f = own.found[own.batch.tag(i)];
    const float speed = std::sqrt(squared_speed(f)), cutoff = reach(pair, speed);
    if (distance2 > cutoff * cutoff) continue;
    const float travel = std::sqrt(distance2) - near;
    own.candidates.features.push_back({f.a, f.b, time_ + (travel > 0 ? travel / speed : 0.0f)});
  }
}

/// Asks for the pairs of features of a body that may meet before its prediction ends, which is no longer than they
/// serve.
void SurfaceSearch::cover_itself(Thread& own, Index b, float min_seconds) {
  SweptBody& body = swept_[b];
  body.limit_deformation(max_self_deformation * bodies_[b].mean_edge, min_seconds);
  own.ways.clear();
  for (Index v = 0; v < body.surface().vertex_count(); ++v)
    own.ways.push_back((body.end() - time_) * glm::length(body.deformation_velocity(v)));
  near_itself_[b].cover(body.surface(), body.run(), reach({b, b, 0, 0, 0, 0}, 0), own.ways,
                        self_margin * bodies_[b].mean_edge, own);
  // As if all were searched anew: the work must not depend on how long pairs were kept.
  own.work += body.surface().feature_count();
}

void SurfaceSearch::find_within(Thread& own, SurfacePair& pair, bool edges) {
  SelfNeighbours& near = near_itself_[pair.a];
  if (edges) {
    near.add_edges(max_box_pairs, own);
    add_edges(own, pair);
  } else {
    near.add_vertex_faces(max_box_pairs, own);
    add_vertex_faces(own, pair, pair.a, pair.a);
    pair.face_vertex = pair.edge_edge = static_cast<std::uint32_t>(own.candidates.features.size());
  }
}

}  // namespace collide::surface
