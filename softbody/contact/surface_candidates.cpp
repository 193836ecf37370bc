#include "softbody/contact/surface_candidates.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "softbody/contact/law.h"
#include "softbody/contact/surface_vectors.h"

namespace softbody {
namespace {

using collide::surface::Closest;
using collide::surface::FeaturePair;
using collide::surface::Surface;
using collide::surface::SurfaceSearch;

constexpr float step_share = 0.15f;  // of the shorter mean edge: how far two bodies may pass each other in a substep
constexpr float patience = 2;        // a motion is foreseen for so many times as long as the last one has lasted
constexpr float unknown = -1;        // in place of a gap at rest that was not needed yet
constexpr float separation_depth = 0.25f;  // of the shorter mean edge: deeper bodies are parted as a whole

/// Returns how far (m) a body may stray that has strayed so far before.
float slack_after(float stray, const collide::surface::SurfaceBody& before) {
  return std::max(2 * stray, before.slack / 2);
}

/// The calmer a body is, the fewer candidates it needs.
void set_slack(collide::surface::SurfaceBody& body, float wanted) {
  const float slack = std::clamp(wanted, 0.015f * body.mean_edge, 0.1f * body.mean_edge);
  body.skin += slack - body.slack;
  body.slack = slack;
}

/// Returns true if a vertex faces the same way as the face of another body that it is closest to. Surfaces that have
/// met face each other, but those of bodies in one place do not.
bool faces_along(const Surface& own, const collide::VertexRun& own_at, Index vertex, const Surface& other,
                 const collide::VertexRun& other_at, Index face) {
  const auto normal = [](const Surface& surface, const collide::VertexRun& at, Index f) {
    const auto& [a, b, c] = surface.triangles()[f];
    return normal_of(at[a], at[b], at[c]);
  };
  glm::vec3 sum(0.0f);
  for (const Index f : own.triangles_at(vertex)) sum += normal(own, own_at, f);
  return glm::dot(sum, normal(other, other_at, face)) > 0;
}

bool near_each_other(const collide::VertexRun& a, const collide::VertexRun& b) {
  return collide::near(collide::measure_bounds(a).box, collide::measure_bounds(b).box, 0.0f);
}

glm::vec3 middle_of(const collide::VertexRun& at) {
  glm::vec3 sum(0.0f);
  for (Index i = 0; i < at.size; ++i) sum += at[i];
  return sum / float(at.size);
}

}  // namespace

void SurfaceCandidates::find(const collide::surface::Motion& motion, std::vector<collide::surface::SurfaceBody> traits,
                             std::vector<ContactBody> bodies, const collide::surface::SurfaceQuery& query, float ahead,
                             collide::Workers& workers) {
  assert(traits.size() == bodies.size());
  std::swap(traits, traits_);
  std::swap(bodies, bodies_);
  for (Index body = 0; body < traits_.size(); ++body) {
    const bool known = body < bodies.size() && bodies[body].inverse_mass > 0;  // a new one is no calm one
    if (!known) {
      set_slack(traits_[body], traits_[body].mean_edge);
      continue;
    }
    const SurfaceSearch::History history = search_.history(body);
    set_slack(traits_[body], slack_after(history.deviation, traits[body]));
    traits_[body].horizon = std::max(ahead, patience * history.duration);
  }
  search(motion.positions, [&] { search_.find(motion, traits_, query, workers); });
}

void SurfaceCandidates::update(const collide::surface::Motion& motion, float elapsed, float ahead,
                               collide::Workers& workers) {
  for (Index body = 0; body < traits_.size(); ++body) {
    const collide::surface::SweptBody& swept = search_.body(body);
    if (!swept.expired()) continue;
    traits_[body].horizon = std::max(ahead, patience * (elapsed - swept.begin()));
    if (swept.exceeds_slack()) set_slack(traits_[body], slack_after(swept.deviation(), traits_[body]));
  }
  search(motion.positions, [&] { search_.update(motion, traits_, elapsed, ahead, workers); });
}

/// Searches, and forgets everything if too many features are near each other: what is remembered belongs to those that
/// were found last.
template <class Search>
void SurfaceCandidates::search(const collide::Frame& now, const Search& search) {
  try {
    search();
  } catch (...) {
    *this = SurfaceCandidates();
    throw;
  }
  take_candidates(now);
}

void SurfaceCandidates::take_candidates(const collide::Frame& now) {
  std::swap(pairs_, pairs_before_);
  std::swap(cached_, cached_before_);
  pairs_.clear();
  for (const collide::surface::SurfacePair& range : search_.pairs()) pairs_.push_back(make_pair(range));
  cached_.assign(search_.features().size(), {});
  rest_gap_.assign(search_.features().size(), unknown);
  carry_over();
  interior_.clear();
  Shells shells;
  for (Pair& p : pairs_)
    if (p.overlap) find_interior_vertices(p, now, shells);
  predict_speeds();
  colour();
}

/// Within a body, what is closer at rest than the distance that surfaces keep is not pushed apart.
float SurfaceCandidates::max_gap(const Pair& pair, std::uint32_t feature) {
  if (pair.range.a != pair.range.b) return pair.distance;
  constexpr float share = 0.9f;
  float& gap = rest_gap_[feature];
  if (gap == unknown) {
    const Surface& surface = *traits_[pair.range.a].surface;
    const std::vector<glm::vec3>& rest = *bodies_[pair.range.a].rest;
    const FeaturePair& f = search_.features()[feature];
    const auto closest = [&] {
      if (feature < pair.range.edge_edge) {
        const auto& [a, b, c] = surface.triangles()[f.b];
        return collide::surface::closest_vertex_face(rest[f.a], rest[a], rest[b], rest[c]);
      }
      const collide::surface::Edge &one = surface.edges()[f.a], &two = surface.edges()[f.b];
      return collide::surface::closest_edges(rest[one[0]], rest[one[1]], rest[two[0]], rest[two[1]]);
    };
    gap = share * glm::length(closest().separation);
  }
  return std::min(pair.distance, gap);
}

/// A pair may be hit through its neighbours within one substep: it is looked at as far as either body's fastest pair
/// goes.
void SurfaceCandidates::predict_speeds() {
  std::vector<float> fastest(bodies_.size(), 0);
  rate_ = 0;
  for (const Pair& p : pairs_) {
    const float speed = search_.max_relative_speed(p.range.a, p.range.b),
                edge = std::min(traits_[p.range.a].mean_edge, traits_[p.range.b].mean_edge);
    for (const Index body : {p.range.a, p.range.b}) fastest[body] = std::max(fastest[body], speed);
    rate_ = std::max(rate_, speed / (step_share * edge));
  }
  for (Pair& p : pairs_) {
    p.speed = std::max(fastest[p.range.a], fastest[p.range.b]);
    p.rate = p.speed / (step_share * std::min(traits_[p.range.a].mean_edge, traits_[p.range.b].mean_edge));
  }
}

SurfaceCandidates::Pair SurfaceCandidates::make_pair(const collide::surface::SurfacePair& range) const {
  const ContactBody &a = bodies_[range.a], &b = bodies_[range.b];
  const auto margin = [&](Index body) { return traits_[body].skin - traits_[body].slack; };
  return {.range = range,
          .offset = glm::vec3(b.origin - a.origin),
          .distance = margin(range.a) + margin(range.b),
          .friction = law::common_friction(a.friction, b.friction),
          .restitution = range.a == range.b ? 0 : law::common_restitution(a.restitution, b.restitution),
          .overlap = range.a != range.b && (traits_[range.a].surface->closed() || traits_[range.b].surface->closed())};
}

/// Hands on what is remembered of the same features. Pairs that were near before know whether they overlap.
void SurfaceCandidates::carry_over() {
  auto old = pairs_before_.begin();
  const std::vector<FeaturePair>& old_features = search_.previous_features();
  const auto hand_on = [&](std::uint32_t from, std::uint32_t from_end, std::uint32_t to, std::uint32_t to_end) {
    if (std::equal(old_features.begin() + from, old_features.begin() + from_end, search_.features().begin() + to,
                   search_.features().begin() + to_end,
                   [](const auto& a, const auto& b) { return a.key() == b.key(); })) {
      std::copy(cached_before_.begin() + from, cached_before_.begin() + from_end, cached_.begin() + to);
      return;
    }
    for (; to < to_end; ++to) {
      while (from < from_end && old_features[from].key() < search_.features()[to].key()) ++from;
      if (from == from_end) return;
      if (old_features[from].key() == search_.features()[to].key()) cached_[to] = cached_before_[from];
    }
  };
  for (Pair& p : pairs_) {
    while (old != pairs_before_.end() && old->range.bodies() < p.range.bodies()) ++old;
    if (old == pairs_before_.end()) return;
    if (p.range.bodies() < old->range.bodies()) continue;
    const collide::surface::SurfacePair &from = old->range, &to = p.range;
    p.overlap = old->overlap;
    hand_on(from.vertex_face, from.face_vertex, to.vertex_face, to.face_vertex);
    hand_on(from.face_vertex, from.edge_edge, to.face_vertex, to.edge_edge);
    hand_on(from.edge_edge, from.end, to.edge_edge, to.end);
  }
}

/// Lists the vertices of two closed bodies that lie inside the other one, with the faces that they are closest to.
void SurfaceCandidates::find_interior_vertices(Pair& pair, const collide::Frame& now, Shells& shells) {
  const auto run = [&](Index body) { return collide::vertices_of(now, body); };
  pair.interior = std::uint32_t(interior_.size());
  pair.interior_end = pair.interior;
  const bool both_closed = traits_[pair.range.a].surface->closed() && traits_[pair.range.b].surface->closed();
  const float deep = separation_depth * std::min(traits_[pair.range.a].mean_edge, traits_[pair.range.b].mean_edge);
  const auto shell = [&](Index body) -> const collide::surface::ClosedShell& {
    shells.resize(bodies_.size());
    if (!shells[body]) shells[body].emplace(*traits_[body].surface, run(body));
    return *shells[body];
  };
  const auto deep_in = [&](Index body, const glm::vec3& point) {
    return shell(body).inside(point) && shell(body).nearest_face(point).distance > deep;
  };
  if (both_closed && near_each_other(run(pair.range.a), run(pair.range.b))) {
    for (const Index body : {pair.range.a, pair.range.b}) {
      const glm::vec3 middle = middle_of(run(body));
      if (deep_in(pair.range.a, middle) && deep_in(pair.range.b, middle)) {
        pair.overlap = pair.separating = true;
        return;
      }
    }
  }
  float deepest = 0;
  std::uint32_t along = 0;
  for (const bool of_b : {false, true}) {
    const Index own = of_b ? pair.range.b : pair.range.a, other = of_b ? pair.range.a : pair.range.b;
    if (!traits_[other].surface->closed()) continue;
    const collide::VertexRun vertices = run(own);
    if (!near_each_other(vertices, run(other))) continue;
    for (Index v = 0; v < vertices.size; ++v) {
      if (!shell(other).inside(vertices[v])) continue;
      const collide::surface::ClosedShell::Nearest nearest = shell(other).nearest_face(vertices[v]);
      deepest = std::max(deepest, nearest.distance);
      along += faces_along(*traits_[own].surface, vertices, v, *traits_[other].surface, run(other), nearest.face);
      interior_.push_back({v, nearest.face, of_b});
    }
  }
  pair.overlap = interior_.size() > pair.interior;
  // Vertex by vertex, bodies far inside each other would only be pressed into nested cups, and those in one place, of
  // which no vertex is deep, be pulled both ways for ever.
  pair.separating = both_closed && (deepest > deep || 2 * along > interior_.size() - pair.interior);
  if (pair.separating) interior_.resize(pair.interior);
  pair.interior_end = std::uint32_t(interior_.size());
}

/// Colours the pairs greedily, in order, so that pairs of one colour share no body. Those for which no colour is left
/// come last, one by one.
void SurfaceCandidates::colour() {
  constexpr std::size_t most = 64;
  std::vector<std::uint64_t> taken(bodies_.size(), 0);
  for (auto& colour : colours_) colour.clear();
  std::size_t used = 0;
  std::vector<std::uint32_t> rest;
  for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
    std::uint64_t &a = taken[pairs_[i].range.a], &b = taken[pairs_[i].range.b];
    const auto free = std::size_t(std::countr_one(a | b));
    if (free == most) {
      rest.push_back(i);
      continue;
    }
    a |= std::uint64_t{1} << free;
    b |= std::uint64_t{1} << free;
    used = std::max(used, free + 1);
    if (colours_.size() < used) colours_.resize(used);
    colours_[free].push_back(i);
  }
  colours_.resize(used);
  for (const std::uint32_t i : rest) colours_.push_back({i});
}

SurfaceCandidates::Side SurfaceCandidates::side(const Pair& pair, bool second) const {
  const Index id = second ? pair.range.b : pair.range.a;
  const ContactBody& body = bodies_[id];
  return {traits_[id].surface, body.first_slot, body.stride, second ? pair.offset : glm::vec3(0.0f),
          body.inverse_mass,   body.held};
}

std::vector<collide::surface::ItemPair> SurfaceCandidates::interactions() const {
  std::vector<collide::surface::ItemPair> list;
  for (const Pair& p : pairs_)
    if (p.range.a != p.range.b && p.range.vertex_face < p.range.end) list.push_back({p.range.a, p.range.b});
  return list;
}

std::pair<Index, Index> SurfaceCandidates::vertex_at(const Pair& pair, std::uint32_t slot) const {
  const ContactBody &a = bodies_[pair.range.a], &b = bodies_[pair.range.b];
  const std::size_t end = a.first_slot + a.stride * traits_[pair.range.a].surface->vertex_count();
  const bool of_a = slot >= a.first_slot && slot < end && (slot - a.first_slot) % a.stride == 0;
  const ContactBody& own = of_a ? a : b;
  return {of_a ? pair.range.a : pair.range.b, Index((slot - own.first_slot) / own.stride)};
}

/// Only features of which something is remembered are kept: most candidates are far apart and forgotten at once.
SurfaceCandidates::State SurfaceCandidates::save() const {
  State state;
  state.traits = traits_;
  state.bodies = bodies_;
  for (Index body = 0; body < bodies_.size(); ++body) state.history.push_back(search_.history(body));
  // By its bits: a zero's sign is handed on too.
  const auto blank = [](const CachedContact& m) {
    return std::bit_cast<std::array<char, sizeof(CachedContact)>>(m) ==
           std::bit_cast<std::array<char, sizeof(CachedContact)>>(CachedContact{});
  };
  const auto keep_features = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      if (blank(cached_[i])) continue;
      state.features.push_back(search_.features()[i]);
      state.cached.push_back(cached_[i]);
    }
    return std::uint32_t(state.features.size());
  };
  for (const Pair& pair : pairs_) {
    Pair& kept = state.pairs.emplace_back(pair);
    const collide::surface::SurfacePair& from = pair.range;
    kept.range.vertex_face = std::uint32_t(state.features.size());
    kept.range.face_vertex = keep_features(from.vertex_face, from.face_vertex);
    kept.range.edge_edge = keep_features(from.face_vertex, from.edge_edge);
    kept.range.end = keep_features(from.edge_edge, from.end);
  }
  return state;
}

void SurfaceCandidates::restore(const State& state) {
  *this = SurfaceCandidates();
  traits_ = state.traits;
  bodies_ = state.bodies;
  search_.restore(state.features, state.history);
  pairs_ = state.pairs;
  cached_ = state.cached;
}

std::size_t SurfaceCandidates::State::bytes() const {
  const auto of = [](const auto& list) { return list.size() * sizeof(list[0]); };
  return of(traits) + of(bodies) + of(history) + of(pairs) + of(features) + of(cached);
}

}  // namespace softbody
