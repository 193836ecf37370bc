#include "collide/surface/swept_body.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace collide::surface {

void SweptBody::predict(const Motion& now, Index body, const SurfaceBody& traits, float begin, float end,
                        float min_seconds) {
  traits_ = traits;
  begin_ = begin, end_ = end;
  deviation_ = 0, holds_until_ = std::numeric_limits<float>::infinity();
  live_ = expired_ = false;
  count_ = now.positions.bodies->size(body);
  if (count_ == 0 || !traits.surface) return;
  assert(traits.surface->vertex_count() == count_);
  const Index first = now.positions.bodies->first[body];
  const auto copy = [&](const auto& from, std::vector<float>& to) {
    to.assign(from.begin() + first, from.begin() + first + count_);
  };
  copy(now.positions.x, start_[0]), copy(now.positions.y, start_[1]), copy(now.positions.z, start_[2]);
  if (traits.moves)
    copy(now.vx, velocity_[0]), copy(now.vy, velocity_[1]), copy(now.vz, velocity_[2]);
  else
    for (auto& v : velocity_) v.assign(count_, 0.0f);
  fit_rigid_motion();
  bound_velocities();
  constexpr float max_share = 0.5f;  // of the mean edge
  limit_deformation(max_share * traits.mean_edge, min_seconds);
}

void SweptBody::fit_rigid_motion() {
  mean_velocity_ = centre_ = glm::vec3(0.0f);
  for (Index v = 0; v < count_; ++v) mean_velocity_ += velocity(v), centre_ += at(v);
  mean_velocity_ = mean_velocity_ / static_cast<float>(count_);
  centre_ = centre_ / static_cast<float>(count_);
  spin_ = glm::vec3(0.0f);
  if (!moves()) return;
  glm::dvec3 momentum(0.0);
  glm::dmat3 inertia(0.0);
  double radius2 = 0;
  for (Index v = 0; v < count_; ++v) {
    const glm::dvec3 arm(at(v) - centre_);
    momentum += glm::cross(arm, glm::dvec3(velocity(v) - mean_velocity_));
    inertia += glm::dmat3(glm::dot(arm, arm)) - glm::outerProduct(arm, arm);
    radius2 += glm::dot(arm, arm);
  }
  inertia += glm::dmat3(1e-6 * radius2);  // vertices on a line may turn about it in any way
  if (radius2 > 0) spin_ = glm::vec3(glm::inverse(inertia) * momentum);
}

void SweptBody::bound_velocities() {
  float spread2 = 0, deformation2 = 0;
  deforming_points_.clear();
  for (Index v = 0; v < count_; ++v) {
    const glm::vec3 relative = velocity(v) - mean_velocity_,
                    deformation = relative - glm::cross(spin_, at(v) - centre_);
    deforming_points_.push_back({at(v), deformation});
    spread2 = std::max(spread2, glm::dot(relative, relative));
    deformation2 = std::max(deformation2, glm::dot(deformation, deformation));
  }
  velocity_spread_ = std::sqrt(spread2);
  max_deformation_speed_ = std::sqrt(deformation2);
}

void SweptBody::limit_deformation(float way, float min_seconds) {
  end_ = std::min(end_, begin_ + std::max(min_seconds, way / max_deformation_speed_));
  bound_path();
}

void SweptBody::bound_path() {
  const float seconds = end_ - begin_;
  glm::vec3 lo = at(0), hi = lo;
  for (Index v = 0; v < count_; ++v) {
    const glm::vec3 x = at(v), relative = velocity(v) - mean_velocity_;
    lo = glm::min(lo, glm::min(x, x + seconds * relative));
    hi = glm::max(hi, glm::max(x, x + seconds * relative));
  }
  local_box_ = {lo - traits_.skin, hi + traits_.skin};
  const glm::vec3 still(0.0f), last = drift(end_);
  world_box_ = {local_box_.lo + glm::min(last, still), local_box_.hi + glm::max(last, still)};
  // The boxes alone do not show a NaN: min and max may drop it.
  const glm::vec3 all = centre_ + mean_velocity_ + (world_box_.hi - world_box_.lo);
  live_ = std::isfinite(all.x + all.y + all.z + velocity_spread_);
}

void SweptBody::build_feature_boxes() {
  assert(live_);
  const float seconds = end_ - begin_;
  BoxColumns path;
  path.resize(count_);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (Index v = 0; v < count_; ++v) {
      const float x = start_[axis][v], y = x + seconds * (velocity_[axis][v] - mean_velocity_[static_cast<int>(axis)]);
      path.lo[axis][v] = std::min(x, y) - traits_.skin;
      path.hi[axis][v] = std::max(x, y) + traits_.skin;
    }
  const SurfacePatches& patches = surface().patches(run());
  vertex_boxes_.fill(patches.vertices, path.lo, path.hi);
  face_boxes_.fill(patches.faces, path.lo, path.hi);
  edge_boxes_.fill(patches.edges, path.lo, path.hi);
}

void SweptBody::place_points(float time) {
  points_.clear();
  for (Index v = 0; v < count_; ++v) points_.push_back({at(v, time), velocity(v)});
}

/// Tests that every face turns its outer side away from the centre: det(a, b, c) > 0 for its corners as seen from the
/// centre. Then a ray from the centre meets the surface the same number of times in every direction, and that number
/// must be 1. The ray through the middle of the first face is counted: it meets that face inside, so that rounding
/// cannot lose it, and no other face may even touch it. Apart from the rigid motion, a corner moves by at most m. That
/// reduces the determinant by at most
///   m (|a x b| + |b x c| + |c x a|) + m^2 (|a| + |b| + |c|) + m^3.
/// This is at most max_loss, which takes the farthest vertex for every corner and is the same for all faces.
bool SweptBody::stays_star_shaped() const {
  assert(live_);
  if (!surface().closed()) return false;
  const float m = (end_ - begin_) * max_deformation_speed_ + traits_.slack;
  float r2 = 0;
  for (Index v = 0; v < count_; ++v) r2 = std::max(r2, glm::dot(at(v) - centre_, at(v) - centre_));
  const float max_loss = m * (3 * r2 + m * (3 * std::sqrt(r2) + m));
  const auto& [first, second, third] = surface().triangles().front();
  const glm::vec3 ray = (at(first) + at(second) + at(third)) / 3.0f - centre_;
  int hits = 0;
  for (const auto& [i, j, k] : surface().triangles()) {
    const glm::vec3 a = at(i) - centre_, b = at(j) - centre_, c = at(k) - centre_, bc = glm::cross(b, c);
    const auto loss = [&] {
      return m * (glm::length(glm::cross(a, b)) + glm::length(bc) + glm::length(glm::cross(c, a))) +
             m * m * (glm::length(a) + glm::length(b) + glm::length(c)) + m * m * m;
    };
    const float det = glm::dot(a, bc);
    if (!(det > max_loss) && !(det > loss())) return false;
    hits += glm::dot(bc, ray) >= 0 && glm::dot(glm::cross(a, b), ray) >= 0 && glm::dot(glm::cross(c, a), ray) >= 0;
  }
  return hits == 1;
}

void SweptBody::update_deviation(const Frame& now, Index body, float time, float until) {
  if (!live_ || !moves()) return;
  const Index first = now.bodies->first[body];
  float deviation2 = 0;
  for (Index v = 0; v < count_; ++v) {
    const glm::vec3 deviation = glm::vec3(now.x[first + v], now.y[first + v], now.z[first + v]) - at(v, time);
    deviation2 = std::max(deviation2, glm::dot(deviation, deviation));
  }
  deviation_ = std::max(deviation_, std::sqrt(deviation2));
  if (time > begin_ && deviation_ > 0) holds_until_ = begin_ + (time - begin_) * std::sqrt(traits_.slack / deviation_);
  expired_ = exceeds_slack() || end_ < until;
}

}  // namespace collide::surface
