#include "collide/surface/surface_search.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace collide::surface {
namespace {

/// Grows every box of a list by what `lo` and `hi` add to its corners.
void grow(BoxList& list, const glm::vec3& lo, const glm::vec3& hi) {
  for (int axis = 0; axis < 3; ++axis)
    for (Index k = 0; k < list.size; ++k) {
      list.lo[static_cast<std::size_t>(axis)][k] += lo[axis];
      list.hi[static_cast<std::size_t>(axis)][k] += hi[axis];
    }
}

template <std::size_t n, std::size_t m>
bool share_vertex(const std::array<Index, n>& a, const std::array<Index, m>& b) {
  return std::any_of(a.begin(), a.end(), [&](Index v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

constexpr std::size_t most_boxes = std::size_t{1} << 26;  // that overlap, of two bodies' features: 512 MiB a thread

/// Whether one body may be wholly inside the other, with no feature near any other.
bool may_hold(const SweptBody& outer, const SweptBody& inner) {
  const Aabb &o = outer.world(), &i = inner.world();
  return outer.surface().closed() && glm::all(glm::lessThan(o.lo, i.lo)) && glm::all(glm::lessThan(i.hi, o.hi));
}

}  // namespace

float SurfaceSearch::speed(const SurfacePair& pair) const {
  const SweptBody &a = swept_[pair.a], &b = swept_[pair.b];
  return glm::length(a.mean_velocity() - b.mean_velocity()) + a.spread() + b.spread();
}

void SurfaceSearch::clear() {
  for (Candidates* c : {&now_, &before_}) c->pairs.clear(), c->features.clear();
}

void SurfaceSearch::recall(std::vector<FeaturePair> features, std::span<const Past> past) {
  clear();
  now_.features = std::move(features);
  end_ = 0;
  swept_.resize(past.size());
  for (std::size_t body = 0; body < past.size(); ++body) swept_[body].recall(past[body].stray, -past[body].lasted);
}

bool SurfaceSearch::holds(const Frame& now, float elapsed, float ahead) {
  bool all = true;
  for (Index body = 0; body < swept_.size(); ++body) {
    swept_[body].look(now, body, elapsed, std::min(elapsed + ahead, end_));
    all = all && !swept_[body].due();
  }
  return all;
}

void SurfaceSearch::require_few(std::size_t features) const {
  if (features > query_.most_features)
    throw std::length_error("more than " + std::to_string(query_.most_features) +
                            " pairs of surface features are near each other: take bodies apart, or away");
}

void SurfaceSearch::find(const Motion& motion, std::span<const SurfaceBody> bodies, const SurfaceQuery& query,
                         Workers& workers) {
  bodies_ = bodies;
  query_ = query;
  time_ = 0, end_ = query.seconds;
  swept_.resize(bodies.size());
  anew_.assign(bodies.size(), true);
  boxed_.assign(bodies.size(), false);
  search(motion, query.least, workers);
}

void SurfaceSearch::renew(const Motion& motion, std::span<const SurfaceBody> bodies, float elapsed, float least,
                          Workers& workers) {
  bodies_ = bodies;
  time_ = elapsed;
  for (Index b = 0; b < swept_.size(); ++b) {
    anew_[b] = swept_[b].due();
    if (anew_[b]) boxed_[b] = false;
  }
  search(motion, least, workers);
}

void SurfaceSearch::search(const Motion& motion, float least, Workers& workers) {
  threads_.resize(static_cast<std::size_t>(workers.threads()));
  const auto in_parts = [&](std::size_t count, const auto& task) {
    workers.run([&](int thread) {
      const Part part = part_of(count, thread, workers.threads());
      for (std::size_t i = part.begin; i < part.end; ++i) task(threads_[static_cast<std::size_t>(thread)], i);
    });
  };
  in_parts(swept_.size(), [&](Thread&, std::size_t b) {
    const float end = std::min(end_, time_ + bodies_[b].foresight);
    if (anew_[b]) swept_[b].foresee(motion, static_cast<Index>(b), bodies_[b], time_, end, least);
  });
  find_near();
  std::swap(now_, before_);
  for (Thread& t : threads_) t.candidates.pairs.clear(), t.candidates.features.clear(), t.found.clear(), t.work = 0;
  in_parts(swept_.size(), [&](Thread& own, std::size_t b) {
    if (!needed_[b] || boxed_[b]) return;
    swept_[b].box_features();
    boxed_[b] = true;
    own.work += swept_[b].surface().feature_count();
  });
  in_parts(near_.size(), [&](Thread& own, std::size_t i) { find_candidates(own, near_[i]); });
  gather();
  work_ = now_.features.size();
  for (const Thread& t : threads_) work_ += t.work;
}

/// Bodies whose boxes overlap, and those that may meet themselves.
void SurfaceSearch::find_near() {
  order_.clear();
  near_.clear();
  needed_.assign(swept_.size(), false);
  foreseen_ = end_;
  for (Index b = 0; b < swept_.size(); ++b) {
    if (!swept_[b].live()) continue;
    order_.push_back(b);
    foreseen_ = std::min(foreseen_, swept_[b].end());
    if (query_.self && swept_[b].moves()) near_.push_back({b, b});
  }
  sweep(
      order_, 0.0f, [&](Index b) -> const Aabb& { return swept_[b].world(); },
      [&](Index a, Index b) {
        if (!swept_[a].moves() && !swept_[b].moves()) return;
        near_.push_back({std::min(a, b), std::max(a, b)});
        if (anew_[a] || anew_[b]) needed_[a] = needed_[b] = true;
      });
  std::sort(near_.begin(), near_.end());
}

void SurfaceSearch::find_candidates(Thread& own, const ItemPair& bodies) {
  const std::size_t before = own.candidates.features.size();
  const auto place = static_cast<std::uint32_t>(before);
  SurfacePair pair{bodies.a, bodies.b, place, place, place, place};
  if (!anew_[pair.a] && !anew_[pair.b])
    stay(own, pair);
  else if (pair.a == pair.b)
    find_self(own, pair);
  else
    find_pair(own, pair);
  pair.end = static_cast<std::uint32_t>(own.candidates.features.size());
  const SweptBody &a = swept_[pair.a], &b = swept_[pair.b];
  if (pair.end > place || may_hold(a, b) || may_hold(b, a)) own.candidates.pairs.push_back(pair);
  require_few(own.candidates.features.size());
}

/// Takes over what was found before.
void SurfaceSearch::stay(Thread& own, SurfacePair& pair) const {
  const auto old = std::lower_bound(before_.pairs.begin(), before_.pairs.end(), pair,
                                    [](const auto& x, const auto& y) { return x.bodies() < y.bodies(); });
  if (old == before_.pairs.end() || old->bodies() != pair.bodies()) return;
  const auto first = before_.features.begin();
  own.candidates.features.insert(own.candidates.features.end(), first + old->vertex_face, first + old->end);
  pair.face_vertex += old->face_vertex - old->vertex_face;
  pair.edge_edge += old->edge_edge - old->vertex_face;
}

/// One thread's pairs after another's.
void SurfaceSearch::gather() {
  now_.pairs.clear(), now_.features.clear();
  for (const Thread& t : threads_) {
    const auto before = static_cast<std::uint32_t>(now_.features.size());
    require_few(now_.features.size() + t.candidates.features.size());
    for (SurfacePair p : t.candidates.pairs) {
      for (std::uint32_t SurfacePair::*place :
           {&SurfacePair::vertex_face, &SurfacePair::face_vertex, &SurfacePair::edge_edge, &SurfacePair::end})
        p.*place += before;
      now_.pairs.push_back(p);
    }
    now_.features.insert(now_.features.end(), t.candidates.features.begin(), t.candidates.features.end());
  }
}

void SurfaceSearch::find_pair(Thread& own, SurfacePair& pair) const {
  const SweptBody &a = swept_[pair.a], &b = swept_[pair.b];
  const float end = std::min(a.end(), b.end());
  const glm::vec3 first = a.drift(time_) - b.drift(time_), last = a.drift(end) - b.drift(end);
  const glm::vec3 lo = glm::min(first, last), hi = glm::max(first, last);
  const auto range = [&] { return static_cast<std::uint32_t>(own.candidates.features.size()); };
  // Seen from b, the boxes of a grow by its drift: instead of those, the box that they are compared with grows at
  // first.
  own.search.pick(a.faces(), {b.box().lo - hi, b.box().hi - lo}, own.faces_a);
  if (own.faces_a.size == 0) return;
  grow(own.faces_a, lo, hi);
  const Aabb near_a = own.faces_a.bounds();
  own.search.pick(b.faces(), near_a, own.faces_b);
  if (own.faces_b.size == 0) return;
  const Aabb near_b = own.faces_b.bounds(), before_drift{near_b.lo - hi, near_b.hi - lo};
  own.search.pick(b.vertices(), near_a, own.vertices_b);
  own.search.pick(b.edges(), near_a, own.edges_b);
  own.search.pick(a.vertices(), before_drift, own.vertices_a);
  own.search.pick(a.edges(), before_drift, own.edges_a);
  grow(own.vertices_a, lo, hi);
  grow(own.edges_a, lo, hi);
  own.search.between(own.vertices_a, own.faces_b, own.found, most_boxes);
  own.work += own.found.size();
  keep_vertices_on_faces(own, pair, pair.a, pair.b);
  pair.face_vertex = range();
  own.search.between(own.vertices_b, own.faces_a, own.found, most_boxes);
  own.work += own.found.size();
  keep_vertices_on_faces(own, pair, pair.b, pair.a);
  pair.edge_edge = range();
  own.search.between(own.edges_a, own.edges_b, own.found, most_boxes);
  own.work += own.found.size();
  keep_edges(own, pair);
}

/// The squared relative speed of two features' corners, the greatest; within a body, of what is not its rigid motion.
template <std::size_t n, std::size_t m>
float SurfaceSearch::fastest(Index a, const std::array<Index, n>& one, Index b, const std::array<Index, m>& two) const {
  float most = 0;
  for (const Index v : one)
    for (const Index w : two) {
      const glm::vec3 u =
          a == b ? swept_[a].strain(v) - swept_[a].strain(w) : swept_[a].velocity(v) - swept_[b].velocity(w);
      most = std::max(most, glm::dot(u, u));
    }
  return most;
}

void SurfaceSearch::keep_vertices_on_faces(Thread& own, const SurfacePair& pair, Index a, Index b) const {
  const auto& faces = swept_[b].surface().triangles();
  for (std::size_t i = 0; i < own.found.size();) {
    own.meeting.clear();
    for (; i < own.found.size() && !own.meeting.full(); ++i) {
      const auto& [u, v, w] = faces[own.found[i].b];
      own.meeting.add({at(a, own.found[i].a), at(b, u), at(b, v), at(b, w)}, static_cast<Index>(i));
    }
    own.meeting.meet_vertices_and_faces();
    keep(own, pair, [&](const ItemPair& f) { return fastest(a, std::array{f.a}, b, faces[f.b]); });
    require_few(own.candidates.features.size());
  }
  own.found.clear();
}

void SurfaceSearch::keep_edges(Thread& own, const SurfacePair& pair) const {
  const auto &ones = swept_[pair.a].surface().edges(), &twos = swept_[pair.b].surface().edges();
  for (std::size_t i = 0; i < own.found.size();) {
    own.meeting.clear();
    for (; i < own.found.size() && !own.meeting.full(); ++i) {
      const Edge &one = ones[own.found[i].a], &two = twos[own.found[i].b];
      own.meeting.add({at(pair.a, one[0]), at(pair.a, one[1]), at(pair.b, two[0]), at(pair.b, two[1])},
                      static_cast<Index>(i));
    }
    own.meeting.meet_edges();
    keep(own, pair, [&](const ItemPair& f) { return fastest(pair.a, ones[f.a], pair.b, twos[f.b]); });
    require_few(own.candidates.features.size());
  }
  own.found.clear();
}

/// Keeps those that met which can come within reach in time. speed2 of two features: (m/s)^2, how fast their corners
/// pass each other.
template <class Speed>
void SurfaceSearch::keep(Thread& own, const SurfacePair& pair, const Speed& speed2) const {
  const SurfaceBody &a = bodies_[pair.a], &b = bodies_[pair.b];
  const float near = 1.1f * (a.skin - a.slack + b.skin - b.slack) + a.slack + b.slack;
  const float seconds = std::min(swept_[pair.a].end(), swept_[pair.b].end()) - time_;
  const float farthest = near + seconds * (pair.a == pair.b ? 2 * swept_[pair.a].most_strain() : speed(pair)),
              farthest2 = farthest * farthest;
  for (Index i = 0; i < own.meeting.size(); ++i) {
    const float distance2 = own.meeting.distance2(i);
    if (distance2 > farthest2) continue;
    const ItemPair& f = own.found[own.meeting.tag(i)];
    const float fast = std::sqrt(speed2(f)), reach = near + seconds * fast;
    if (distance2 > reach * reach) continue;
    const float way = std::sqrt(distance2) - near;
    own.candidates.features.push_back({f.a, f.b, time_ + (way > 0 ? way / fast : 0.0f)});
  }
}

void SurfaceSearch::find_self(Thread& own, SurfacePair& pair) const {
  const SweptBody& body = swept_[pair.a];
  if (body.unfolded()) return;
  const Surface& surface = body.surface();
  own.work += surface.feature_count();
  body.box_strained(own.vertices);
  join(own.vertices, surface.triangles(), own.faces);
  join(own.vertices, surface.edges(), own.edges);
  own.search.between(own.vertices, own.faces, own.found, most_boxes);
  own.work += own.found.size();
  std::erase_if(own.found, [&](const ItemPair& f) { return share_vertex(std::array{f.a}, surface.triangles()[f.b]); });
  keep_vertices_on_faces(own, pair, pair.a, pair.a);
  pair.face_vertex = pair.edge_edge = static_cast<std::uint32_t>(own.candidates.features.size());
  own.search.within(own.edges, own.found, most_boxes);
  own.work += own.found.size();
  std::erase_if(own.found, [&](const ItemPair& f) { return share_vertex(surface.edges()[f.a], surface.edges()[f.b]); });
  keep_edges(own, pair);
}

}  // namespace collide::surface
