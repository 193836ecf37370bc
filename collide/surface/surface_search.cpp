#include "collide/surface/surface_search.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace collide::surface {
namespace {

constexpr float max_self_deformation = 0.25f;  // of the mean edge: of a body that may touch itself, in one prediction
constexpr float rounding_share = 16 * std::numeric_limits<float>::epsilon();  // of the largest coordinates
constexpr std::size_t max_box_pairs = std::size_t{1} << 26;  // of two bodies: up to 2 GiB for each thread

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
  for (Thread& t : threads_) t.features.clear(), t.work = 0;
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
    if (!may_touch_itself_[b]) return;
    body.limit_deformation(max_self_deformation * bodies_[b].mean_edge, min_seconds);
    own.work += body.surface().feature_count();
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

/// Finds the pairs of features of two bodies that may meet before one of their predictions ends. In the frame of the
/// later body, the boxes of the first one grow by the relative drift.
void SurfaceSearch::find_between(Thread& own, Index first, const PatchBoxes& boxes, Index later,
                                 const PatchBoxes& others) const {
  const SweptBody &a = swept_[first], &b = swept_[later];
  const float end = std::min(a.end(), b.end());
  const glm::vec3 now = a.drift(time_) - b.drift(time_), then = a.drift(end) - b.drift(end);
  own.search.find_between(boxes, glm::min(now, then), glm::max(now, then), others, max_box_pairs);
  own.work += own.search.size();
}

/// Finds the pairs of features of a body that may meet before its prediction ends.
void SurfaceSearch::find_within(Thread& own, Index index, const FeaturePatches& ones,
                                const FeaturePatches& twos) const {
  const SweptBody& body = swept_[index];
  assert(body.begin() == time_);
  const bool one_list = &ones == &twos;  // of edges
  const glm::vec3 far = glm::max(glm::abs(body.local_box().lo), glm::abs(body.local_box().hi));
  const float half = 0.5f * reach(index, index) + rounding_share * (far.x + far.y + far.z);
  own.rooms.clear();
  for (const MovingPoint& p : body.deforming_points())
    own.rooms.push_back(half + (body.end() - time_) * glm::length(p.velocity));
  own.ones.fill(ones, body.start(), body.start(), own.rooms);
  if (!one_list) own.twos.fill(twos, body.start(), body.start(), own.rooms);
  const auto& [vertex_faces, edge_edges] = body.surface().joints(body.run());
  own.search.find_within(own.ones, one_list ? own.ones : own.twos, one_list ? edge_edges : vertex_faces, max_box_pairs);
}

/// Returns the distance (m) within which features may be within 1.1 times their contact distance, as predicted.
float SurfaceSearch::reach(Index body_a, Index body_b) const {
  const SurfaceBody &a = bodies_[body_a], &b = bodies_[body_b];
  return 1.1f * (a.skin - a.slack + b.skin - b.slack) + a.slack + b.slack;
}

/// Adds the pairs of a feature of each body, or of one body, that can come within reach of each other before the
/// prediction ends, in order. Their distance and relative speed bound the earliest time of that, as in conservative
/// advancement. Without branches that nobody can predict.
template <PairKind kind>
void SurfaceSearch::add_reachable(Thread& own, Index a, Index b) const {
  const SweptBody &one = swept_[a], &two = swept_[b];
  constexpr bool edges = kind == PairKind::edge_edge;
  constexpr std::size_t corners_of_one = corners_of_first(kind), corners_of_two = 4 - corners_of_one;
  const SurfacePatches &patches = one.surface().patches(one.run()), &others = two.surface().patches(two.run());
  const FeaturePatches &ones = edges ? patches.edges : patches.vertices, &twos = edges ? others.edges : others.faces;
  const PatchBoxes &boxes_a = edges ? one.edge_boxes() : one.vertex_boxes(),
                   &boxes_b = edges ? two.edge_boxes() : two.face_boxes();
  if (a == b)
    find_within(own, a, ones, twos);
  else if (a < b)
    find_between(own, a, boxes_a, b, boxes_b);
  else
    find_between(own, b, boxes_b, a, boxes_a);

  const auto& points = a == b ? &SweptBody::deforming_points : &SweptBody::points;
  const std::vector<MovingPoint>&p = (one.*points)(), &q = (two.*points)();
  const float near = reach(a, b), seconds = std::min(one.end(), two.end()) - time_,
              max_distance = near + seconds * max_relative_speed(a, b), max_distance2 = max_distance * max_distance;
  const std::size_t begin = own.features.size();
  std::array<ItemPair, FeatureBatch::capacity> places;  // of the batch
  const auto add_batch = [&] {
    own.batch.find_closest<kind>();
    std::array<Index, FeatureBatch::capacity> near_ones;
    std::size_t count = 0, size = own.features.size();
    for (Index k = 0; k < own.batch.size(); ++k) {
      near_ones[count] = k;
      count += !(own.batch.distance2(k) > max_distance2);  // NaN, where products overflow, is near
    }
    own.features.resize(size + count);
    for (const Index k : std::span(near_ones).first(count)) {
      const auto& [i, j] = places[k];
      float speed2 = 0;
      for (std::size_t u = 0; u < corners_of_one; ++u)
        for (std::size_t v = 0; v < corners_of_two; ++v) {
          const glm::vec3 relative = p[ones.corners[i][u]].velocity - q[twos.corners[j][v]].velocity;
          speed2 = std::max(speed2, glm::dot(relative, relative));
        }
      const float distance2 = own.batch.distance2(k), travel = std::sqrt(distance2) - near;
      const float speed = std::sqrt(speed2), cutoff = near + seconds * speed;
      own.features[size] = {ones.feature[i], twos.feature[j], time_ + (travel > 0 ? travel / speed : 0.0f)};
      size += !(distance2 > cutoff * cutoff);
    }
    own.features.resize(size);
    check_feature_limit(size);
    own.batch.clear();
  };
  own.batch.clear();
  own.search.for_each([&](Index first, Index second) {
    const bool turn = a == b ? edges && twos.feature[second] < ones.feature[first] : b < a;
    const Index turned = (first ^ second) & (Index{0} - Index{turn}), i = first ^ turned, j = second ^ turned;
    const std::array<Index, 3>&c = ones.corners[i], &d = twos.corners[j];
    std::array<glm::vec3, 4> at;
    for (std::size_t u = 0; u < corners_of_one; ++u) at[u] = p[c[u]].at;
    for (std::size_t v = 0; v < corners_of_two; ++v) at[corners_of_one + v] = q[d[v]].at;
    places[own.batch.size()] = {i, j};
    own.batch.add(at, 0);
    if (own.batch.full()) add_batch();
  });
  add_batch();
  own.sort.sort(std::span(own.features).subspan(begin), ones.size(), twos.size());
}

}  // namespace collide::surface
