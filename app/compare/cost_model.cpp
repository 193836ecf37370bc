#include "app/compare/cost_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include <glm/common.hpp>

#include "app/base/text.h"
#include "collide/core/cutoff.h"
#include "collide/core/cuts.h"
#include "collide/methods/cell_hash.h"

namespace app::compare {
namespace {

/// Returns true if the estimate is what the method does on every frame.
bool is_certain(const collide::Method& method) { return method.tests != collide::PairTests::of_near_vertices; }

std::uint64_t whole(double number) { return static_cast<std::uint64_t>(std::min(number, 1e18)); }

}  // namespace

std::string WorkEstimate::in_words() const {
  const bool tests = pair_tests >= cost() / 2;
  const std::uint64_t number = tests ? pair_tests : hashes;
  const char* what = tests ? " pair tests" : " hash evaluations";
  return (number < 10'000'000 ? grouped(number) : grouped(number / 1'000'000) + " million") + what;
}

std::uint64_t all_pair_tests(const collide::Bodies& bodies, bool self_collision) {
  std::uint64_t tests = pairs_of(bodies.vertex_count());
  if (self_collision) return tests;
  for (collide::Index b = 0; b < bodies.count(); ++b) tests -= pairs_of(bodies.size(b));
  return tests;
}

void CostModel::begin(const collide::Frame& frame, const collide::Settings& settings, std::uint64_t world) {
  assert(collide::is_complete(frame));
  const collide::Bodies& bodies = *frame.bodies;
  if (world != world_ || settings != settings_) learnt_.clear();
  learnt_.resize(collide::method_table().size());
  world_ = world;
  settings_ = settings;
  vertices_ = bodies.vertex_count();
  bodies_ = bodies.count();
  all_ = all_pair_tests(bodies, settings.self_collision);

  sample_.draw(frame, settings.self_collision);
  collide::Result unused;
  boxes_.build(frame, unused);
  glm::dvec3 lo(1e300), hi(-1e300);
  side_ = glm::dvec3(0);
  for (const collide::Index b : boxes_.live) {
    lo = glm::min(lo, glm::dvec3(boxes_.box[b].lo));
    hi = glm::max(hi, glm::dvec3(boxes_.box[b].hi));
    side_ += (glm::dvec3(boxes_.box[b].hi) - glm::dvec3(boxes_.box[b].lo)) / static_cast<double>(boxes_.live.size());
  }
  extent_ = boxes_.live.empty() ? glm::dvec3(0) : hi - lo;
  in_overlapping_boxes_ = exact_tests_ = 0;
  const auto add = [&](std::uint64_t tests, std::uint64_t vertices) {
    in_overlapping_boxes_ += tests;
    // Of the vertices that face another body, or of patches that are near each other.
    exact_tests_ += std::max(16 * vertices, std::min(tests / 8, 512 * vertices));
  };
  for (const auto& [a, b] : pairs_.find(boxes_, collide::contact_cutoff(settings.tolerance)))
    add(std::uint64_t{bodies.size(a)} * bodies.size(b), bodies.size(a) + bodies.size(b));
  if (!settings.self_collision) return;
  for (const collide::Index b : boxes_.live) add(pairs_of(bodies.size(b)), bodies.size(b));
}

WorkEstimate CostModel::of(std::size_t method) const {
  assert(method < learnt_.size());
  const Learnt& learnt = learnt_[method];
  const collide::Method& row = collide::method_table()[method];
  if (learnt.vertices == 0 || is_certain(row)) return estimate(row);
  const double growth = vertices_ / learnt.vertices;  // more bodies since then: the pairs grow with its square
  return {whole(static_cast<double>(learnt.work.pair_tests) * growth * growth),
          whole(static_cast<double>(learnt.work.hashes) * growth)};
}

void CostModel::learn(std::size_t method, const collide::Counters& counters) {
  assert(method < learnt_.size());
  learnt_[method] = {{counters.pair_tests, counters.hashes}, vertices_};
}

/// Returns the number of buckets that the hash can reach. Poor primes leave buckets empty: the sum in the hash is a
/// multiple of the common divisor of primes and bucket count, and bounded by the cells of the frame.
double CostModel::reachable_buckets() const {
  std::uint64_t common = settings_.buckets;
  double max_sum = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint64_t prime = settings_.primes[static_cast<std::size_t>(axis)] % settings_.buckets;
    common = std::gcd(common, prime);
    max_sum += static_cast<double>(prime) * (extent_[axis] / static_cast<double>((*settings_.cell_size)[axis]) + 1);
  }
  return std::min(static_cast<double>(settings_.buckets / common), max_sum);
}

/// Returns the number of pairs that meet in such a grid; see PairSample::share().
double CostModel::pairs_near(const glm::dvec3& cell, const glm::dvec3& reach) const {
  return static_cast<double>(pairs_of(static_cast<std::uint64_t>(vertices_))) * sample_.share(cell, reach);
}

WorkEstimate CostModel::estimate(const collide::Method& method) const {
  if (method.tests == collide::PairTests::all) return {all_, 0};
  if (method.uses_hash) return estimate_hashed(method);
  if (is_certain(method)) return {in_overlapping_boxes_, 0};
  if (method.group == collide::MethodGroup::paper) return {std::min(exact_tests_, in_overlapping_boxes_), 0};
  const glm::dvec3 tolerance(static_cast<double>(settings_.tolerance));
  return {std::min(all_, whole(64 * vertices_ + pairs_near(tolerance, tolerance))), 0};
}

WorkEstimate CostModel::estimate_hashed(const collide::Method& method) const {
  const glm::dvec3 cell(*settings_.cell_size), padding(static_cast<double>(settings_.tolerance));
  const double boxes = std::min(std::ldexp(bodies_, settings_.levels), vertices_);
  const bool complete = method.uses_levels && method.exact;
  glm::dvec3 box;  // m, the sides of a subdivided one, on average
  for (int axis = 0; axis < 3; ++axis)
    box[axis] = std::ldexp(side_[axis], -collide::cuts_along(axis, settings_.levels));
  // A box is in eight cells, or in all that it overlaps with its padding; a vertex looks into the cells around it.
  const glm::dvec3 reach = method.uses_levels ? box + (complete ? padding : glm::dvec3(0)) : padding;
  const glm::dvec3 along = 1.0 + (method.uses_levels ? 1.0 : 2.0) * reach / cell;
  const double cells = method.uses_levels && !complete ? 8 : along.x * along.y * along.z;
  const double room = collide::methods::room_for_cells / (method.uses_levels ? boxes : 1);  // on average
  if (cells > collide::methods::max_listed_cells(vertices_, room) && method.exact) return {all_, 0};
  const double entry_pairs = method.uses_levels ? cells * cells : cells;
  const double hashes = method.uses_levels ? boxes * cells : vertices_ * (1 + cells);
  const double aliased = static_cast<double>(all_) * entry_pairs / reachable_buckets();
  return {std::min(all_, whole(pairs_near(cell, reach) + aliased)), whole(hashes)};
}

}  // namespace app::compare
