#include "app/reference/reference_trajectory.h"

#include <algorithm>
#include <cassert>

#include <glm/geometric.hpp>

#include "softbody/world/measures.h"

namespace app::reference {
namespace {

constexpr std::uint64_t bound_every = 4, check_every = 64;  // steps
constexpr int settled_checks = 8;
constexpr double top_of_arc = 1e-3;  // s: at the top of its arc a body is slow, too, but for a shorter time

/// Returns the largest speed (m/s) of a particle relative to the body's mean.
double fastest(const BodyState& s) {
  const glm::dvec3 mean = rigid_motion(s).velocity;
  double max = 0;
  for (const glm::dvec3& v : s.v) max = std::max(max, glm::distance(v, mean));
  return max;
}

}  // namespace

double unsettled_speed(const ReferenceBody& body, const BodyState& s) {
  const softbody::Scene& scene = body.scene();
  const bool free =
      scene.gravity == glm::dvec3(0.0) && std::ranges::none_of(s.x, [&](const glm::dvec3& p) {
        return softbody::solid_depth(scene, p).depth > -body.model().material[softbody::Material::thickness];
      });
  return free ? deformation_speed(s) : rms_distance(s.v, std::vector<glm::dvec3>(s.v.size(), glm::dvec3(0.0)));
}

glm::dvec3 random_vector(std::mt19937& random) {
  // Not std::uniform_real_distribution, which differs between libraries.
  const auto signed_unit = [&] { return 2 * double(random()) / double(std::mt19937::max()) - 1; };
  // Braces, because the order in which a function's arguments are evaluated differs between compilers.
  return glm::dvec3{signed_unit(), signed_unit(), signed_unit()};
}

BodyState perturbed(BodyState s, double size) {
  std::mt19937 random(1);
  for (glm::dvec3& p : s.x) p += size * random_vector(random);
  return s;
}

Trajectory integrate(const ReferenceBody& body, BodyState s, double fraction, const TrajectoryLimits& limits) {
  assert(fraction > 0);
  Trajectory trajectory;
  double left = limits.seconds, h = 0;
  int calm_checks = 0;
  const double settled_seconds = body.scene().gravity == glm::dvec3(0.0) ? 0 : top_of_arc;
  for (double left_when_unsettled = left; left > 0; ++trajectory.steps) {
    if (trajectory.steps % bound_every == 0)  // the stable step holds only for the current shape
      h = fraction * std::min(body.stable_step(s), 0.1 * body.model().radius / fastest(s));
    if (trajectory.steps == limits.steps) {
      trajectory.complete = false;
      break;
    }
    const double now = h < left ? h : left;
    body.step(s, now);
    left -= now;
    if (limits.settled_speed <= 0 || trajectory.steps % check_every != 0) continue;
    calm_checks = unsettled_speed(body, s) < limits.settled_speed ? calm_checks + 1 : 0;
    if (calm_checks == 0) left_when_unsettled = left;
    if (calm_checks >= settled_checks && left_when_unsettled - left >= settled_seconds) break;
  }
  trajectory.end = std::move(s);
  return trajectory;
}

Reference find_reference(const ReferenceBody& body, const BodyState& start, double bound,
                         const TrajectoryLimits& limits) {
  const double radius = body.model().radius;
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

}  // namespace app::reference
