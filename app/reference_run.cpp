#include "app/reference_run.h"

#include <algorithm>
#include <random>

#include "softbody/measures.h"

namespace app {
namespace {

constexpr std::uint64_t bound_every = 8, look_every = 64;  // steps

/// Whether nothing can happen to it any more but that it flies on.
bool out_of_reach(const ReferenceBody& body, const BodyState& s) {
  const softbody::Scene& scene = body.scene();
  if (scene.gravity != glm::dvec3(0.0)) return false;
  return std::ranges::none_of(s.x, [&](const glm::dvec3& p) {
    return softbody::solid_depth(scene, p).depth > -body.prototype().material.thickness;
  });
}

BodyState disturbed(BodyState s, double size) {
  std::mt19937 random(1);
  // Not by std::uniform_real_distribution, which is another one in each library.
  const auto either_way = [&] { return 2 * double(random()) / double(std::mt19937::max()) - 1; };
  for (glm::dvec3& p : s.x) p += size * glm::dvec3(either_way(), either_way(), either_way());
  return s;
}

}  // namespace

Flight fly(const ReferenceBody& body, BodyState s, double fraction, const FlightLimits& limits) {
  Flight flight;
  double left = limits.seconds, h = 0;
  for (int calm = 0; left > 0; ++flight.steps) {
    if (flight.steps % bound_every == 0) h = fraction * body.stable_step(s);
    if (flight.steps == limits.steps) {
      flight.complete = false;
      break;
    }
    const double now = h < left ? h : left;
    body.step(s, now);
    left -= now;
    if (limits.settled_speed <= 0 || flight.steps % look_every != 0) continue;
    calm = internal_speed(s) < limits.settled_speed && out_of_reach(body, s) ? calm + 1 : 0;
    if (calm < 8) continue;
    flight.settled = true;
    break;
  }
  flight.end = std::move(s);
  return flight;
}

Reference find_reference(const ReferenceBody& body, const BodyState& start, double bound, const FlightLimits& limits) {
  const double radius = body.prototype().radius;
  double fraction = 1;
  Flight best = fly(body, start, fraction, limits);
  Reference r;
  while (best.complete && !r.converged) {
    Flight finer = fly(body, start, fraction / 2, limits);
    if (!finer.complete) break;
    fraction /= 2;
    r.change = rms_distance(best.end.x, finer.end.x) / radius;
    r.converged = r.change <= bound;
    best = std::move(finer);
  }
  r.step = limits.seconds / double(best.steps);
  const BodyState shifted = disturbed(start, 1e-8 * radius);
  r.growth = rms_distance(fly(body, shifted, fraction, limits).end.x, best.end.x) / rms_distance(shifted.x, start.x);
  r.end = std::move(best.end);
  return r;
}

}  // namespace app
