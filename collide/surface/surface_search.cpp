#include "collide/surface/surface_search.h"

#include <algorithm>
#include <array>
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

/// Returns true if one body may be wholly inside the other; then no features need be near each other.
bool may_contain(const SweptBody& outer, const SweptBody& inner) {
  const Aabb &o = outer.world_box(), &i = inner.world_box();
  return outer.surface().closed() && glm::all(glm::lessThan(o.lo, i.lo)) && glm::all(glm::lessThan(i.hi, o.hi));
}

}  // namespace

float SurfaceSearch::max_relative_speed(Index body_a, Index body_b) const {
  const SweptBody &a = swept_[body_a], &b = swept_[body_b];
  if (body_a == body_b) return 2 * a.max_deformation_speed();
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
  for (Thread& t : threads_) t.features.clear(), t.found.clear(), t.work = 0;
  constexpr double vertex_ns = 20, task_ns = 500;  // of work
  const auto share = [&](double work, std::size_t count, const auto& task) {
    workers.share(workers.threads_for(work), count,
                  [&](int thread, std::size_t i) { task(threads_[static_cast<std::size_t>(thread)], i); });
  };
  const auto share_bodies = [&](const std::vector<char>& which, const auto& task) {
    due_.clear();
    double vertices = 0;
    for (Index b = 0; b < swept_.size(); ++b) {
      if (!which[b]) continue;
      due_.push_back(b);
      vertices += motion.positions.bodies->size(b);
    }
    share(vertex_ns * vertices, due_.size(), [&](Thread& own, std::size_t i) { task(own, due_[i]); });
  };
  share_bodies(predicted_anew_, [&](Thread& own, Index b) {
    const float end = std::min(end_, time_ + bodies_[b].horizon);
    SweptBody& body = swept_[b];
    body.predict(motion, b, bodies_[b], time_, end, min_seconds);
    may_touch_itself_[b] = query_.self && body.live() && body.moves() && !body.stays_star_shaped();
    if (may_touch_itself_[b]) cover_itself(own, b, min_seconds);
  });
  find_tasks();
  std::swap(current_, previous_);
  share_bodies(needs_boxes_, [&](Thread& own, Index b) {
    swept_[b].place_points(time_);
    if (has_boxes_[b]) return;
    swept_[b].build_feature_boxes();
    has_boxes_[b] = true;
    own.work += swept_[b].surface().feature_count();
  });
  const auto tasks = static_cast<double>(tasks_.size());
  share(task_ns * tasks, tasks_.size(), [&](Thread& own, std::size_t i) { find_candidates(own, tasks_[i]); });
  merge_tasks();
  work_ = current_.features.size();
  for (const Thread& t : threads_) work_ += t.work;
}

/// Finds the pairs of bodies whose boxes overlap, and the bodies that may touch themselves. The broad phase.
void SurfaceSearch::find_tasks() {
  order_.clear();
  tasks_.clear();
  needs_boxes_.assign(swept_.size(), false);
  predicted_until_ = end_;
  for (Index b = 0; b < swept_.size(); ++b) {
    if (!swept_[b].live()) continue;
    order_.push_back(b);
    predicted_until_ = std::min(predicted_until_, swept_[b].end());
    if (!may_touch_itself_[b]) continue;
    for (const Task::Kind kind : {Task::Kind::vertex_face, Task::Kind::edge_edge}) tasks_.push_back({b, b, kind});
  }
  sweep(
      order_, 0.0f, [&](Index b) -> const Aabb& { return swept_[b].world_box(); },
      [&](Index a, Index b) {
        if (!swept_[a].moves() && !swept_[b].moves()) return;
        for (const Task::Kind kind : {Task::Kind::vertex_face, Task::Kind::face_vertex, Task::Kind::edge_edge})
          tasks_.push_back({std::min(a, b), std::max(a, b), kind});
        if (predicted_anew_[a] || predicted_anew_[b]) needs_boxes_[a] = needs_boxes_[b] = true;
      });
  std::sort(tasks_.begin(), tasks_.end(), [](const Task& x, const Task& y) { return x.key() < y.key(); });
}

void SurfaceSearch::find_candidates(Thread& own, Task& task) {
  if (!predicted_anew_[task.a] && !predicted_anew_[task.b]) {
    reuse_previous(task);
    return;
  }
  task.in = &own.features;
  task.begin = own.features.size();
  if (task.a != task.b)
    find_between(own, task);
  else if (task.kind == Task::Kind::edge_edge)
    near_itself_[task.a].add_edges(max_box_pairs, own);
  else
    near_itself_[task.a].add_vertex_faces(max_box_pairs, own);
  switch (task.kind) {
    case Task::Kind::vertex_face:
      add_reachable<PairKind::vertex_face>(own, task.a, task.b);
      break;
    case Task::Kind::face_vertex:
      add_reachable<PairKind::vertex_face>(own, task.b, task.a);
      break;
    case Task::Kind::edge_edge:
      add_reachable<PairKind::edge_edge>(own, task.a, task.b);
  }
  task.end = own.features.size();
  own.found.clear();
}

void SurfaceSearch::reuse_previous(Task& task) const {
  const auto old = std::lower_bound(previous_.pairs.begin(), previous_.pairs.end(), std::pair(task.a, task.b),
                                    [](const SurfacePair& x, const auto& bodies) { return x.bodies() < bodies; });
  if (old == previous_.pairs.end() || old->bodies() != std::pair(task.a, task.b)) return;
  const std::array bounds{old->vertex_face, old->face_vertex, old->edge_edge, old->end};
  const auto kind = static_cast<std::size_t>(task.kind);
  task.in = &previous_.features;
  task.begin = bounds[kind];
  task.end = bounds[kind + 1];
}

/// Puts the candidates in the order of the tasks.
void SurfaceSearch::merge_tasks() {
  auto& [pairs, features] = current_;
  pairs.clear(), features.clear();
  for (std::size_t i = 0; i < tasks_.size();) {
    const Index a = tasks_[i].a, b = tasks_[i].b;
    std::array<std::uint32_t, 4> bounds;
    bounds.fill(static_cast<std::uint32_t>(features.size()));
    for (; i < tasks_.size() && tasks_[i].a == a && tasks_[i].b == b; ++i) {
      const Task& task = tasks_[i];
      check_feature_limit(features.size() + task.end - task.begin);
      if (task.begin < task.end)
        features.insert(features.end(), task.in->begin() + static_cast<std::ptrdiff_t>(task.begin),
                        task.in->begin() + static_cast<std::ptrdiff_t>(task.end));
      std::fill(bounds.begin() + static_cast<std::ptrdiff_t>(task.kind) + 1, bounds.end(),
                static_cast<std::uint32_t>(features.size()));
    }
    if (bounds.back() > bounds.front() || may_contain(swept_[a], swept_[b]) || may_contain(swept_[b], swept_[a]))
      pairs.push_back({a, b, bounds[0], bounds[1], bounds[2], bounds[3]});
  }
}

void SurfaceSearch::find_between(Thread& own, const Task& task) const {
  const SweptBody &a = swept_[task.a], &b = swept_[task.b];
  const float end = std::min(a.end(), b.end());
  const glm::vec3 first = a.drift(time_) - b.drift(time_), last = a.drift(end) - b.drift(end);
  const glm::vec3 lo = glm::min(first, last), hi = glm::max(first, last);
  // In the frame of b, the boxes of a grow by the relative drift. To select the boxes of a before they are grown, the
  // box that they are compared with grows the opposite way.
  const auto take_a = [&](const BoxList& boxes, const Aabb& near) {
    own.search.pick(boxes, {near.lo - hi, near.hi - lo}, own.boxes_a);
    grow(own.boxes_a, lo, hi);
  };
  const auto take_b = [&](const BoxList& boxes, const Aabb& near) { own.search.pick(boxes, near, own.boxes_b); };
  take_a(a.face_boxes(), b.local_box());
  if (own.boxes_a.size == 0) return;
  const Aabb near_a = own.boxes_a.bounds();
  take_b(b.face_boxes(), near_a);
  if (own.boxes_b.size == 0) return;
  const Aabb near_b = own.boxes_b.bounds();
  switch (task.kind) {
    case Task::Kind::vertex_face:
      take_a(a.vertex_boxes(), near_b);
      own.search.between(own.boxes_a, own.boxes_b, own.found, max_box_pairs);
      break;
    case Task::Kind::face_vertex:
      take_b(b.vertex_boxes(), near_a);
      own.search.between(own.boxes_b, own.boxes_a, own.found, max_box_pairs);
      break;
    case Task::Kind::edge_edge:
      take_a(a.edge_boxes(), near_b);
      take_b(b.edge_boxes(), near_a);
      own.search.between(own.boxes_a, own.boxes_b, own.found, max_box_pairs);
  }
  own.work += own.found.size();
}

/// Asks for the pairs of features of a body that may meet before its prediction ends, which is no longer than they
/// serve.
void SurfaceSearch::cover_itself(Thread& own, Index b, float min_seconds) {
  SweptBody& body = swept_[b];
  body.limit_deformation(max_self_deformation * bodies_[b].mean_edge, min_seconds);
  own.ways.clear();
  for (const MovingPoint& p : body.deforming_points())
    own.ways.push_back((body.end() - time_) * glm::length(p.velocity));
  near_itself_[b].cover(body.surface(), body.run(), reach(b, b, 0), own.ways, self_margin * bodies_[b].mean_edge, own);
  // As if all were searched anew: the work must not depend on how long pairs were kept.
  own.work += body.surface().feature_count();
}

/// Returns the distance (m) from which features that move at `speed` relative to each other can come within 1.1 times
/// their contact distance before the prediction ends.
float SurfaceSearch::reach(Index body_a, Index body_b, float speed) const {
  const SurfaceBody &a = bodies_[body_a], &b = bodies_[body_b];
  const float near = 1.1f * (a.skin - a.slack + b.skin - b.slack) + a.slack + b.slack;
  return near + (std::min(swept_[body_a].end(), swept_[body_b].end()) - time_) * speed;
}

/// Adds the pairs found that can come within reach of each other before the prediction ends, in order. Their distance
/// and relative speed bound the earliest time of that, as in conservative advancement.
template <PairKind kind>
void SurfaceSearch::add_reachable(Thread& own, Index a, Index b) const {
  assert(a != b || swept_[a].begin() == time_);
  const Surface &one = swept_[a].surface(), &two = swept_[b].surface();
  constexpr bool edges = kind == PairKind::edge_edge;
  constexpr std::size_t ones = corners_of_first(kind);
  const auto end_a = static_cast<Index>(edges ? one.edges().size() : one.vertex_count());
  const auto end_b = static_cast<Index>(edges ? two.edges().size() : two.triangles().size());
  const auto& points = a == b ? &SweptBody::deforming_points : &SweptBody::points;
  const std::vector<MovingPoint>&p = (swept_[a].*points)(), &q = (swept_[b].*points)();
  const auto corners = [&](const ItemPair& f) {
    const std::array<Index, 4> c = corners_of<kind>(one, f.a, two, f.b);
    return std::array{&p[c[0]], &(edges ? p : q)[c[1]], &q[c[2]], &q[c[3]]};
  };
  const float near = reach(a, b, 0), max_distance = reach(a, b, max_relative_speed(a, b)),
              max_distance2 = max_distance * max_distance;
  own.sort.sort(own.found, end_a, end_b);
  for (std::size_t i = 0; i < own.found.size();) {
    own.batch.clear();
    for (; i < own.found.size() && !own.batch.full(); ++i) {
      const std::array<const MovingPoint*, 4> c = corners(own.found[i]);
      own.batch.add({c[0]->at, c[1]->at, c[2]->at, c[3]->at}, static_cast<Index>(i));
    }
    own.batch.find_closest<kind>();
    for (Index k = 0; k < own.batch.size(); ++k) {
      const float distance2 = own.batch.distance2(k);
      if (distance2 > max_distance2) continue;
      const ItemPair& f = own.found[own.batch.tag(k)];
      const std::array<const MovingPoint*, 4> c = corners(f);
      float speed2 = 0;
      for (std::size_t u = 0; u < ones; ++u)
        for (std::size_t v = ones; v < 4; ++v) {
          const glm::vec3 relative = c[u]->velocity - c[v]->velocity;
          speed2 = std::max(speed2, glm::dot(relative, relative));
        }
      const float speed = std::sqrt(speed2), cutoff = reach(a, b, speed);
      if (distance2 > cutoff * cutoff) continue;
      const float travel = std::sqrt(distance2) - near;
      own.features.push_back({f.a, f.b, time_ + (travel > 0 ? travel / speed : 0.0f)});
    }
    check_feature_limit(own.features.size());
  }
}

}  // namespace collide::surface
