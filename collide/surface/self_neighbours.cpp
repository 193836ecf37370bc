#include "collide/surface/self_neighbours.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "collide/surface/closest_parameters.h"
#include "collide/surface/swept_body.h"

namespace collide::surface {
namespace {

constexpr float rounding_share = 16 * std::numeric_limits<float>::epsilon();

/// Returns the largest value of the corners of a feature.
template <std::size_t n>
float largest(const std::array<Index, n>& corners, std::span<const float> values) {
  float most = values[corners[0]];
  for (std::size_t k = 1; k < n; ++k) most = std::max(most, values[corners[k]]);
  return most;
}

/// Grows the boxes of the features that a list holds by their rooms; there may be more rooms.
void grow(BoxList& boxes, std::span<const float> rooms) {
  assert(boxes.size <= rooms.size());
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (Index k = 0; k < boxes.size; ++k) {
      boxes.lo[axis][k] -= rooms[k];
      boxes.hi[axis][k] += rooms[k];
    }
}

/// Copies each box to one of two lists.
template <class Belongs>
void divide(const BoxList& all, const Belongs& belongs_to_one, BoxList& one, BoxList& other) {
  for (BoxList* list : {&one, &other}) list->clear(), list->reserve(all.size);
  for (Index k = 0; k < all.size; ++k) (belongs_to_one(all.item[k]) ? one : other).add(all.box(k), all.item[k]);
  for (BoxList* list : {&one, &other}) list->end();
}

glm::vec3 centre_of(const VertexRun& at) {
  glm::vec3 sum(0.0f);
  for (Index v = 0; v < at.size; ++v) sum += at[v];
  return sum / static_cast<float>(at.size);
}

}  // namespace

void SelfNeighbours::take_reference(const VertexRun& at) {
  centre_ = centre_of(at);
  rotation_ = glm::quat(1, 0, 0, 0);
  reference_.resize(at.size);
  strayed_.assign(at.size, true);
  glm::dmat3 inertia(0.0);
  double radius2 = 0;
  for (Index v = 0; v < at.size; ++v) {
    const glm::vec3 x = reference_[v] = at[v] - centre_;
    const double r2 = static_cast<double>(glm::dot(x, x));
    inertia += glm::dmat3(r2) - glm::outerProduct(glm::dvec3(x), glm::dvec3(x));
    radius2 += r2;
  }
  inertia += glm::dmat3(1e-6 * radius2 + 1e-30);  // a little more about every axis, for vertices on a line
  inverse_inertia_ = glm::mat3(glm::inverse(inertia));
}

/// Bounds the errors of closest_features.h, and of positions about the centre.
void SelfNeighbours::bound_rounding() {
  float longest2 = 0, radius2 = 0;
  for (const auto& [a, b] : surface_->edges()) {
    const glm::vec3 along = reference_[b] - reference_[a];
    longest2 = std::max(longest2, glm::dot(along, along));
    radius2 = std::max(radius2, glm::dot(reference_[a], reference_[a]));
  }
  rounding_ = std::sqrt(degenerate_sine2 * longest2) + rounding_share * std::sqrt(radius2);
}

/// Fits the rotation by Newton's method from the last one: any is good enough for the proof. A body that has turned far
/// meanwhile is measured to have deviated far.
void SelfNeighbours::fit_rotation(const VertexRun& at) {
  constexpr int max_steps = 4;
  constexpr float exact = 1e-4f;  // an angle
  centre_ = centre_of(at);
  for (int step = 0; step < max_steps; ++step) {
    const glm::mat3 turn = glm::mat3_cast(rotation_);
    glm::vec3 torque(0.0f);
    for (Index v = 0; v < at.size; ++v) {
      const glm::vec3 place = turn * reference_[v];
      torque += glm::cross(place, at[v] - centre_ - place);
    }
    const glm::vec3 angle = turn * (inverse_inertia_ * (glm::transpose(turn) * torque));
    if (!(glm::dot(angle, angle) > exact * exact)) return;
    rotation_ = glm::normalize(glm::quat(1, 0.5f * angle) * rotation_);
  }
}

/// Calls visit(corners, number) for each feature.
template <class Visit>
void SelfNeighbours::for_each_feature(const Visit& visit) const {
  Index number = 0;
  for (Index v = 0; v < surface_->vertex_count(); ++v) visit(std::array{v}, number++);
  for (const Triangle& face : surface_->triangles()) visit(face, number++);
  for (const Edge& edge : surface_->edges()) visit(edge, number++);
}

/// A feature needs room for half of the distance, its deviation and its way.
void SelfNeighbours::measure_needs(const VertexRun& at, float near, std::span<const float> ways, float margin,
                                   Scratch& s) {
  const glm::mat3 turn = glm::mat3_cast(rotation_);
  const float half = 0.5f * (near + rounding_ + rounding_share * glm::length(centre_));
  s.deviations.resize(at.size);
  for (Index v = 0; v < at.size; ++v) s.deviations[v] = glm::length(at[v] - centre_ - turn * reference_[v]);
  for_each_feature([&](const auto& corners, Index i) {
    const float way = largest(corners, ways);
    need_[i] = half + largest(corners, s.deviations) + way;
    margin_[i] = margin + way;  // what moves fast needs more soon
  });
}

void SelfNeighbours::cover(const Surface& surface, const VertexRun& at, float near, std::span<const float> ways,
                           float margin, Scratch& scratch) {
  assert(surface.vertex_count() == at.size && ways.size() == at.size);
  searched_ = 0;
  if (surface_ == &surface && !vertex_faces_.due && !edges_.due) {
    fit_rotation(at);
    measure_needs(at, near, ways, margin, scratch);
    if (std::ranges::equal(need_, room_, std::ranges::less_equal())) return;
    strayed_.assign(at.size, false);
    for_each_feature([&](const auto& corners, Index i) {
      if (room_[i] < need_[i] + 0.5f * margin_[i] || room_[i] > 2 * (need_[i] + margin_[i]))
        for (const Index v : corners) strayed_[v] = true;
    });
    const glm::mat3 back = glm::transpose(glm::mat3_cast(rotation_));
    for (Index v = 0; v < at.size; ++v)
      if (strayed_[v]) reference_[v] = back * (at[v] - centre_);
  } else {
    surface_ = &surface;
    take_reference(at);
    for (std::vector<float>* lengths : {&need_, &margin_, &room_}) lengths->resize(surface.feature_count());
  }
  bound_rounding();
  measure_needs(at, near, ways, margin, scratch);
  bool calm = true;  // but for what strays
  for_each_feature([&](const auto& corners, Index i) { calm = calm && (strays(corners) || need_[i] <= room_[i]); });
  if (!calm) strayed_.assign(at.size, true);  // for the rounding of a reference shape that has become much larger
  for_each_feature([&](const auto& corners, Index i) {
    if (strays(corners)) room_[i] = need_[i] + margin_[i];
  });
  searched_ = static_cast<Index>(std::ranges::count(strayed_, true));
  vertex_faces_.due = edges_.due = true;
}

template <class Corners>
bool SelfNeighbours::strays(const Corners& corners) const {
  return std::ranges::any_of(corners, [&](Index v) { return strayed_[v] != 0; });
}

/// Makes the boxes of the vertices and of other features, with their rooms, and those of what strays and of the others.
/// first: the number of the first of these features.
template <std::size_t n>
void SelfNeighbours::divide_features(const std::vector<std::array<Index, n>>& features, Index first, Scratch& s) const {
  s.vertices.clear();
  s.vertices.reserve(static_cast<Index>(reference_.size()));
  for (Index v = 0; v < reference_.size(); ++v) s.vertices.add({reference_[v], reference_[v]}, v);
  s.vertices.end();
  join(s.vertices, features, s.features);
  grow(s.vertices, room_);
  grow(s.features, std::span(room_).subspan(first));
  const auto vertex_strays = [&](Index v) { return strayed_[v] != 0; };
  const auto feature_strays = [&](Index i) { return strays(features[i]); };
  divide(s.vertices, vertex_strays, s.strayed_vertices, s.calm_vertices);
  divide(s.features, feature_strays, s.strayed, s.calm);
}

/// Replaces the pairs of what strays by those found that are near each other in the reference shape.
template <PairKind kind>
void SelfNeighbours::keep_near(List& list, Scratch& s) {
  constexpr auto ones = static_cast<std::ptrdiff_t>(corners_of_first(kind));
  const auto corners = [&](const auto& pair) { return corners_of<kind>(*surface_, pair.a, *surface_, pair.b); };
  const auto share_vertex = [](const std::array<Index, 4>& c) {
    return std::find_first_of(c.begin(), c.begin() + ones, c.begin() + ones, c.end()) != c.begin() + ones;
  };
  std::erase_if(list.near, [&](const Near& n) { return strays(corners(n)); });
  for (std::size_t i = 0; i < s.found.size();) {
    s.batch.clear();
    for (; i < s.found.size() && !s.batch.full(); ++i) {
      const std::array<Index, 4> c = corners(s.found[i]);
      if (share_vertex(c)) continue;
      s.batch.add({reference_[c[0]], reference_[c[1]], reference_[c[2]], reference_[c[3]]}, static_cast<Index>(i));
    }
    s.batch.find_closest<kind>();
    for (Index k = 0; k < s.batch.size(); ++k) {
      const ItemPair& f = s.found[s.batch.tag(k)];
      const float distance = std::sqrt(s.batch.distance2(k));
      if (distance <= room_[list.first_a + f.a] + room_[list.first_b + f.b]) list.near.push_back({f.a, f.b, distance});
    }
  }
  s.found.clear();
  list.due = false;
}

void SelfNeighbours::add_needed(const List& list, Scratch& s) const {
  for (const Near& n : list.near)
    if (n.distance <= need_[list.first_a + n.a] + need_[list.first_b + n.b]) s.found.push_back({n.a, n.b});
}

void SelfNeighbours::add_vertex_faces(std::size_t max_pairs, Scratch& s) {
  if (vertex_faces_.due) {
    vertex_faces_.first_b = surface_->vertex_count();
    divide_features(surface_->triangles(), vertex_faces_.first_b, s);
    s.found.clear();
    s.search.between(s.strayed_vertices, s.features, s.found, max_pairs);
    s.search.between(s.calm_vertices, s.strayed, s.found, max_pairs);
    keep_near<PairKind::vertex_face>(vertex_faces_, s);
  }
  add_needed(vertex_faces_, s);
}

void SelfNeighbours::add_edges(std::size_t max_pairs, Scratch& s) {
  if (edges_.due) {
    edges_.first_a = edges_.first_b = surface_->vertex_count() + static_cast<Index>(surface_->triangles().size());
    divide_features(surface_->edges(), edges_.first_a, s);
    s.found.clear();
    s.search.within(s.strayed, s.found, max_pairs);
    s.search.between(s.strayed, s.calm, s.found, max_pairs);
    for (ItemPair& f : s.found) f = {std::min(f.a, f.b), std::max(f.a, f.b)};
    keep_near<PairKind::edge_edge>(edges_, s);
  }
  add_needed(edges_, s);
}

}  // namespace collide::surface
