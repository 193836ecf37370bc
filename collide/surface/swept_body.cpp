#include "collide/surface/swept_body.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace collide::surface {
namespace {

template <std::size_t corners>
void join_any(const BoxList& vertices, const std::vector<std::array<Index, corners>>& features, BoxList& list) {
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

constexpr float strain_share = 0.5f;  // of the mean edge

glm::vec3 below(const glm::vec3& v) { return glm::min(v, glm::vec3(0.0f)); }
glm::vec3 above(const glm::vec3& v) { return glm::max(v, glm::vec3(0.0f)); }

}  // namespace

void join(const BoxList& vertices, const std::vector<Triangle>& features, BoxList& list) {
  join_any(vertices, features, list);
}
void join(const BoxList& vertices, const std::vector<Edge>& features, BoxList& list) {
  join_any(vertices, features, list);
}

void SweptBody::foresee(const Motion& now, Index body, const SurfaceBody& traits, float begin, float end, float least) {
  traits_ = traits;
  begin_ = begin, end_ = end;
  stray_ = 0;
  live_ = due_ = false;
  count_ = now.positions.bodies->size(body);
  if (count_ == 0 || !traits.surface) return;
  const Index first = now.positions.bodies->first[body];
  const auto take = [&](const auto& from, std::vector<float>& to) {
    to.assign(from.begin() + first, from.begin() + first + count_);
  };
  take(now.positions.x, start_[0]), take(now.positions.y, start_[1]), take(now.positions.z, start_[2]);
  if (traits.moves)
    take(now.vx, velocity_[0]), take(now.vy, velocity_[1]), take(now.vz, velocity_[2]);
  else
    for (auto& v : velocity_) v.assign(count_, 0.0f);
  find_rigid_motion();
  find_bounds(least);
}

void SweptBody::find_rigid_motion() {
  mean_ = centre_ = glm::vec3(0.0f);
  for (Index v = 0; v < count_; ++v) mean_ += velocity(v), centre_ += at(v);
  mean_ = mean_ / static_cast<float>(count_);
  centre_ = centre_ / static_cast<float>(count_);
  spin_ = glm::vec3(0.0f);
  if (!moves()) return;
  glm::vec3 momentum(0.0f);
  float inertia = 0;
  for (Index v = 0; v < count_; ++v) {
    const glm::vec3 arm = at(v) - centre_;
    momentum += glm::cross(arm, velocity(v) - mean_);
    inertia += glm::dot(arm, arm) * (2.0f / 3);  // as if it were a ball: any spin will do
  }
  if (inertia > 0) spin_ = momentum / inertia;
}

void SweptBody::find_bounds(float least) {
  float spread2 = 0, strain2 = 0;
  for (Index v = 0; v < count_; ++v) {
    const glm::vec3 own = velocity(v) - mean_, left = own - glm::cross(spin_, at(v) - centre_);
    spread2 = std::max(spread2, glm::dot(own, own));
    strain2 = std::max(strain2, glm::dot(left, left));
  }
  spread_ = std::sqrt(spread2);
  most_strain_ = std::sqrt(strain2);
  end_ = std::min(end_, begin_ + std::max(least, strain_share * traits_.edge / most_strain_));
  const float seconds = end_ - begin_;
  glm::vec3 lo = at(0), hi = lo;
  for (Index v = 0; v < count_; ++v) {
    const glm::vec3 x = at(v), own = velocity(v) - mean_;
    lo = glm::min(lo, glm::min(x, x + seconds * own));
    hi = glm::max(hi, glm::max(x, x + seconds * own));
  }
  box_ = {lo - traits_.skin, hi + traits_.skin};
  world_ = {box_.lo + below(drift(end_)), box_.hi + above(drift(end_))};
  const glm::vec3 all = centre_ + mean_ + (world_.hi - world_.lo);  // boxes alone do not show a NaN
  live_ = std::isfinite(all.x + all.y + all.z + spread_);
}

void SweptBody::box_features() {
  const float seconds = end_ - begin_;
  vertices_.clear();
  vertices_.reserve(count_);
  for (Index v = 0; v < count_; ++v) {
    const glm::vec3 x = at(v), y = x + seconds * (velocity(v) - mean_);
    vertices_.add({glm::min(x, y) - traits_.skin, glm::max(x, y) + traits_.skin}, v);
  }
  vertices_.end();
  join(vertices_, surface().triangles(), faces_);
  join(vertices_, surface().edges(), edges_);
}

void SweptBody::box_strained(BoxList& vertices) const {
  const float seconds = end_ - begin_, turn = seconds * glm::length(spin_);
  vertices.clear();
  vertices.reserve(count_);
  for (Index v = 0; v < count_; ++v) {
    const glm::vec3 s = seconds * strain(v);
    const float grown = traits_.skin + turn * glm::length(s);
    vertices.add({at(v) + below(s) - grown, at(v) + above(s) + grown}, v);
  }
  vertices.end();
}

/// Every face must turn its outside away from the middle: det(a, b, c) > 0 for its corners. Then the way out from the
/// middle meets the surface the same number of times in every direction, and once is asked for. A motion of at most m a
/// corner takes no more than m (|a x b| + |b x c| + |c x a|) + m^2 (|a| + |b| + |c|) + m^3 from a determinant, and that
/// is no more than `most` of it with the farthest corner for all.
bool SweptBody::unfolded() const {
  if (!surface().closed()) return false;
  const float m = (end_ - begin_) * most_strain_ + traits_.slack;
  float r2 = 0;
  for (Index v = 0; v < count_; ++v) r2 = std::max(r2, glm::dot(at(v) - centre_, at(v) - centre_));
  const float most = m * (3 * r2 + m * (3 * std::sqrt(r2) + m));
  int met = 0;
  for (const auto& [i, j, k] : surface().triangles()) {
    const glm::vec3 a = at(i) - centre_, b = at(j) - centre_, c = at(k) - centre_, bc = glm::cross(b, c);
    const auto lost = [&] {
      return m * (glm::length(glm::cross(a, b)) + glm::length(bc) + glm::length(glm::cross(c, a))) +
             m * m * (glm::length(a) + glm::length(b) + glm::length(c)) + m * m * m;
    };
    const float det = glm::dot(a, bc);
    if (!(det > most) && !(det > lost())) return false;
    met += bc.y > 0 && glm::cross(a, b).y > 0 && glm::cross(c, a).y > 0;  // by the way up
  }
  return met == 1;
}

void SweptBody::look(const Frame& now, Index body, float time, float until) {
  if (!live_ || !moves()) return;
  const Index first = now.bodies->first[body];
  float strayed2 = 0;
  for (Index v = 0; v < count_; ++v) {
    const glm::vec3 stray = glm::vec3(now.x[first + v], now.y[first + v], now.z[first + v]) - at(v, time);
    strayed2 = std::max(strayed2, glm::dot(stray, stray));
  }
  stray_ = std::max(stray_, std::sqrt(strayed2));
  due_ = strayed() || end_ < until;
}

}  // namespace collide::surface
