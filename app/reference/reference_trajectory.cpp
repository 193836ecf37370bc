#include "app/reference/reference_trajectory.h"

#include <algorithm>
#include <random>

#include <glm/geometric.hpp>

#include "softbody/measures.h"

namespace app {
namespace {

constexpr std::uint64_t bound_every = 4, look_every = 64;  // steps
constexpr int calm_looks = 8;
constexpr double top_of_flight = 1e-3;  // s: what gravity acts on is slow there, too, for a shorter time

/// m/s, of a particle against the body's mean.
double fastest(const BodyState& s) {
  const glm::dvec3 mean = rigid_motion(s).velocity;
  double most = 0;
  for (const glm::dvec3& v : s.v) most = std::max(most, glm::distance(v, mean));
  return most;
}

/// The bound holds for the shape at hand: no particle goes further than a tenth of the body's radius in a step.
double longest_step(const ReferenceBody& body, const BodyState& s) {
  return std::min(body.stable_step(s), 0.1 * body.prototype().radius / fastest(s));
}

}  // namespace

double unsettled_speed(const ReferenceBody& body, const BodyState& s) {
  const softbody::Scene& scene = body.scene();
  const bool free = scene.gravity == glm::dvec3(0.0) && std::ranges::none_of(s.x, [&](const glm::dvec3& p) {
                      return softbody::solid_depth(scene, p).depth > -body.prototype().material.thickness;
                    });
  return free ? deformation_speed(s) : rms_distance(s.v, std::vector<glm::dvec3>(s.v.size(), glm::dvec3(0.0)));
}

BodyState perturbed(BodyState s, double size) {
  std::mt19937 random(1);
  // Not by std::uniform_real_distribution, which is another one in each library.
  const auto either_way = [&] { return 2 * double(random()) / double(std::mt19937::max()) - 1; };
  // Braces: in a function's arguments each compiler would draw in an order of its own.
  for (glm::dvec3& p : s.x) p += size * glm::dvec3{either_way(), either_way(), either_way()};
  return s;
}

Trajectory integrate(const ReferenceBody& body, BodyState s, double fraction, const TrajectoryLimits& limits) {
  Trajectory flight;
  double left = limits.seconds, h = 0;
  int calm = 0;
  const double calm_seconds = body.scene().gravity == glm::dvec3(0.0) ? 0 : top_of_flight;
  for (double calm_since = left; left > 0; ++flight.steps) {
    if (flight.steps % bound_every == 0) h = fraction * longest_step(body, s);
    if (flight.steps == limits.steps) {
      flight.complete = false;
      break;
    }
    const double now = h < left ? h : left;
    body.step(s, now);
    left -= now;
    if (limits.settled_speed <= 0 || flight.steps % look_every != 0) continue;
    calm = unsettled_speed(body, s) < limits.settled_speed ? calm + 1 : 0;
    if (calm == 0) calm_since = left;
    if (calm < calm_looks || calm_since - left < calm_seconds) continue;
    flight.settled = true;
    break;
  }
  flight.end = std::move(s);
  return flight;
}

Reference find_reference(const ReferenceBody& body, const BodyState& start, double bound,
                         const TrajectoryLimits& limits) {
  const double radius = body.prototype().radius;
  double fraction = 1;
  Trajectory best = integrate(body, start, fraction, limits);
  Reference r;
  while (best.complete && !r.converged) {
    Trajectory finer = integrate(body, start, fraction / 2, limits);
    if (!finer.complete) break;
    fraction /= 2;
    r.change = rms_distance(best.end.x, finer.end.x) / radius;
    r.converged = r.change <= bound;
    best = std::move(finer);
  }
  r.step = limits.seconds / double(best.steps);
  const BodyState shifted = perturbed(start, 1e-8 * radius);
  r.growth =
      rms_distance(integrate(body, shifted, fraction, limits).end.x, best.end.x) / rms_distance(shifted.x, start.x);
  r.end = std::move(best.end);
  return r;
}

}  // namespace app
