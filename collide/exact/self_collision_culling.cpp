#include "collide/exact/self_collision_culling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "collide/core/cutoff.h"

namespace collide::exact {

namespace {

/// m: more than a length can lose where squares of floats underflow, twice over: sqrt(3) 2^-75 + 2^-75.
constexpr double lost_below = 0x1p-73;
constexpr float largest_radius = 1e18f;  // m: of a reference whose squared distances are finite

/// A lower bound of the smallest singular value of a 3 x 3 matrix: the eigenvalues of M^T M lie within sqrt(2) standard
/// deviations of their mean (Samuelson's inequality for three values).
double least_singular_value(const std::array<float, 9>& m) {
  std::array<double, 6> g{};  // xx, yy, zz, xy, xz, yz of M^T M
  for (std::size_t row = 0; row < 3; ++row) {
    const double a = m[3 * row], b = m[3 * row + 1], c = m[3 * row + 2];
    g[0] += a * a, g[1] += b * b, g[2] += c * c, g[3] += a * b, g[4] += a * c, g[5] += b * c;
  }
  const double mean = (g[0] + g[1] + g[2]) / 3;
  const double off = g[3] * g[3] + g[4] * g[4] + g[5] * g[5];
  const double spread = (g[0] - mean) * (g[0] - mean) + (g[1] - mean) * (g[1] - mean) + (g[2] - mean) * (g[2] - mean);
  const double variance = (spread + 2 * off) / 3;
  const double rounding =
      1e-13 * mean;  // of the products, many times over: the difference may be far smaller than they
  return std::sqrt(std::max(0.0, mean - std::sqrt(2 * variance) - rounding)) * (1 - 1e-9);
}

}  // namespace

CullingReference::CullingReference(const VertexRun& positions, const Topology& topology, float cutoff)
    : cutoff_(cutoff) {
  const Index size = positions.size;
  if (size < min_vertices || size > max_vertices) return;
  const BodyBounds bound = measure_bounds(positions);
  if (!(bound.finite && bound.radius < largest_radius)) return;
  glm::dvec3 centre(0);
  Index sampled = 0;
  for_samples(size, [&](Index v) {
    centre += glm::dvec3(positions.x[v], positions.y[v], positions.z[v]);
    ++sampled;
  });
  centre /= sampled;
  glm::dmat3 moment(0);
  for_samples(size, [&](Index v) {
    const glm::dvec3 p = glm::dvec3(positions.x[v], positions.y[v], positions.z[v]) - centre;
    moment += glm::outerProduct(p, p);
  });
  double farthest = 0;
  for (Index v = 0; v < size; ++v) {
    const glm::dvec3 p = glm::dvec3(positions.x[v], positions.y[v], positions.z[v]) - centre;
    x_.push_back(static_cast<float>(p.x));
    y_.push_back(static_cast<float>(p.y));
    z_.push_back(static_cast<float>(p.z));
    farthest = std::max(farthest, glm::dot(p, p));
  }
  radius_ = static_cast<float>(std::sqrt(farthest) * (1 + 1e-6));
  const double scale = (moment[0][0] + moment[1][1] + moment[2][2]) / 3;
  if (!(glm::determinant(moment) > 1e-4 * scale * scale * scale)) return;  // flat
  const glm::dmat3 inverse = glm::inverse(moment);
  for (std::size_t k = 0; k < 9; ++k) {
    inverse_moment_[k] = static_cast<float>(inverse[static_cast<int>(k / 3)][static_cast<int>(k % 3)]);
    if (!std::isfinite(inverse_moment_[k])) return;
  }
  usable_ = true;
  list_pairs(topology);
}

void CullingReference::list_pairs(const Topology& topology) {
  const auto size = static_cast<Index>(x_.size());
  covered_ = cutoff_ + 0.3f * radius_;
  std::vector<std::pair<float, std::array<Index, 2>>> listed;
  for (Index a = 0; a < size; ++a) {
    for (Index b = a + 1; b < size; ++b) {
      const float d2 = squared_distance(x_[a], y_[a], z_[a], x_[b], y_[b], z_[b]);
      if (d2 < covered_ * covered_ && !topology.joined(a, b)) listed.push_back({std::sqrt(d2), {a, b}});
    }
  }
  const std::size_t max_pairs = x_.size() * x_.size() / 128;  // to test them takes a third of a self pass
  if (listed.size() > max_pairs) {
    const auto first_left_out = listed.begin() + static_cast<std::ptrdiff_t>(max_pairs);
    std::nth_element(listed.begin(), first_left_out, listed.end());
    covered_ = first_left_out->first;
    listed.resize(max_pairs);
  }
  std::sort(listed.begin(), listed.end());
  covered_ = covered_ * (1 - 1e-6f) - static_cast<float>(lost_below);  // for the rounding of the distances
  for (const auto& [distance, pair] : listed) {
    distance_.push_back(distance);
    pairs_.push_back(pair);
  }
}

SelfCollisionCandidates CullingReference::candidates_of(const VertexRun& body, const BodyBounds& bound,
                                                        Scratch& scratch) const {
  scratch.residual2.resize(body.size);
  const AffineFit fit = fit_affine(body, {x_.data(), y_.data(), z_.data(), static_cast<Index>(x_.size())},
                                   inverse_moment_, bound.centre, scratch.residual2);
  // Residuals were computed in float. With u = 2^-24 each of their coordinates errs by at most 8u of the sum of what
  // went into it, which is at most:
  double size = bound.radius;
  for (const float m : fit.matrix) size += std::abs(double{m}) * radius_;
  for (const float t : fit.offset) size += std::abs(double{t});
  const double rounding = 2 * 8 * 0x1p-24 * size + lost_below;
  const double stretch = least_singular_value(fit.matrix);
  const double allowed = (stretch * covered_ - cutoff_) * (0.5 - 1e-6) - rounding;  // of a residual
  if (!(allowed > 0)) return {};                                                    // also where it is no number
  if (fit.residual <= allowed) {
    const double needed = (cutoff_ + 2 * (fit.residual + rounding)) / stretch * (1 + 1e-6) + lost_below;
    const auto end = std::upper_bound(distance_.begin(), distance_.end(), round_up(needed));
    return {true, std::span(pairs_).first(static_cast<std::size_t>(end - distance_.begin())), {}};
  }
  if (scratch.outliers.size() < body.size + max_lanes) scratch.outliers.resize(body.size + max_lanes);
  constexpr double largest = std::numeric_limits<float>::max();  // an infinite residual is never allowed
  const auto allowed2 = static_cast<float>(std::min(allowed * allowed * (1 - 1e-6), largest));
  const Index outliers = list_above(scratch.residual2, allowed2, scratch.outliers.data());
  if (outliers > body.size / 8) return {};
  return {true, pairs_, std::span(scratch.outliers).first(outliers)};
}

void SelfCollisionCulling::update(const Frame& frame, std::span<const Index> live, float cutoff) {
  for (auto& [topology, entry] : entries_) entry.bodies = 0;
  by_body_.resize(frame.bodies->count());
  Entry* entry = nullptr;
  for (const Index body : live) {
    const Shape& shape = *frame.bodies->shape[body];
    if (!entry || entry->topology != shape.shared_topology()) {
      entry = &entries_[&shape.topology()];
      entry->topology = shape.shared_topology();
    }
    if (entry->bodies++ == 0) entry->first_body = body;
    by_body_[body] = entry;
  }
  std::erase_if(entries_, [](const auto& item) { return item.second.bodies == 0; });
  for (auto& [topology, made] : entries_) {
    if (made.cutoff != cutoff) make(made, frame, cutoff);
  }
}

void SelfCollisionCulling::forget() {
  for (auto& [topology, entry] : entries_) entry.cutoff = entry.from_frame ? 0 : entry.cutoff;
}

void SelfCollisionCulling::make(Entry& entry, const Frame& frame, float cutoff) {
  const Shape& shape = *frame.bodies->shape[entry.first_body];
  const Index first = frame.bodies->first[entry.first_body], size = shape.vertex_count();
  entry.reference.reset();
  entry.from_frame = shape.rest().empty();
  if (size > std::min(CullingReference::max_vertices, vertices_a_body * entry.bodies)) return;
  entry.cutoff = cutoff;
  std::vector<float> x, y, z;
  for (const glm::vec3& p : shape.rest()) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  const VertexRun run = entry.from_frame ? VertexRun{&frame.x[first], &frame.y[first], &frame.z[first], size}
                                         : VertexRun{x.data(), y.data(), z.data(), size};
  auto reference = std::make_unique<CullingReference>(run, shape.topology(), cutoff);
  if (reference->usable()) entry.reference = std::move(reference);
}

}  // namespace collide::exact
