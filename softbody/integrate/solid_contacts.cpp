// Dynamics: contacts with solids, on the particles' velocities.

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "softbody/contact/kernels.h"
#include "softbody/contact/solid_placement.h"
#include "softbody/integrate/dynamics.h"
#include "softbody/scene/solids.h"

namespace softbody {

void Dynamics::solids(const Worker& worker, float h) {
  for (Batch* batch : worker.batches()) solids(*batch, h);
}

/// Particles, and where it is asked for also what lies between them, which may push particles back.
void Dynamics::solids(Batch& b, float h) {
  if (particles_on_solids(b, h, false) && has_solid_features_ && solid_features(b, h)) particles_on_solids(b, h, true);
}

/// Each solid in turn. Where two act on one body the later may push a particle into the earlier, as in a groove: they
/// take turns until what is left is slow, or for so long (Gauss and Seidel). False if there is no solid near.
bool Dynamics::particles_on_solids(Batch& b, float h, bool again) {
  constexpr int max_passes = 8;
  constexpr float slack = 1e-4f;  // m/s
  unsigned acted = again ? ~0u : 0;
  for (int pass = 0; pass < max_passes; ++pass) {
    bool more = false;
    for (SolidArguments& s : b.near_solids) {
      s.h = h;
      s.slack = pass || again ? slack : 0;
      const unsigned now = act_by_solid(b.width, b.used, s, at(x_, b), at(v_, b));
      more = more || (acted & now) || (pass && now);
      acted |= now;
      b.contacted |= now;
    }
    if (!more) break;
  }
  return !b.near_solids.empty();
}

/// Which solids the bodies of a batch may touch in the coming frame, by their boxes and how far they may move: a
/// particle may go twice as far as its body's fastest goes now, and a tenth of the body's size.
void Dynamics::prepare_solids(Batch& b, double seconds) {
  const Extent e = extent(b, x_, v_);
  b.near_solids.clear();
  b.solid_features.clear();
  for_each_solid(scene_, [&](const auto& solid) { prepare_solid(b, e, seconds, solid); });
}

template <class Solid>
void Dynamics::prepare_solid(Batch& b, const Extent& e, double seconds, const Solid& solid) {
  const auto near = [&](int l) {  // the plane before the solid, as seen from the box's centre, cuts the box
    const glm::dvec3 lo(e.lo.x[l], e.lo.y[l], e.lo.z[l]), hi(e.hi.x[l], e.hi.y[l], e.hi.z[l]);
    const SolidSurface s = surface_at(solid, bodies_[b.body[std::size_t(l)]].origin + 0.5 * (lo + hi));
    return s.distance - 0.5 * glm::dot(glm::abs(s.normal), hi - lo) <= max_travel(b, e, l, seconds);
  };
  unsigned lanes_near = 0;
  for (int l = 0; l < b.used; ++l) lanes_near |= unsigned(near(l)) << l;
  if (!lanes_near) return;
  const double thickness = b.model->material.thickness;
  SolidArguments& s = b.near_solids.emplace_back();
  s.particles = b.particles();
  s.mass = float(b.model->particle_mass);
  s.friction = float(solid.friction);
  s.restitution = float(solid.restitution);
  s.shape = shape_of<float>(solid, thickness);
  for (int l = 0; l < b.used; ++l) {
    const glm::dvec3 origin = bodies_[b.body[std::size_t(l)]].origin;
    const glm::dvec3 place = place_of(solid, thickness, origin) - origin;
    s.place.x[l] = float(place.x), s.place.y[l] = float(place.y), s.place.z[l] = float(place.z);
  }
  s.near = lanes_near;
  s.moves = b.moves.data();
  s.impulse = {b.impulse.x, b.impulse.y, b.impulse.z};
  s.returned = b.returned.data();
  if (has_restitution_) s.before = at(std::as_const(before_), b);
  if (!has_solid_features_) return;
  const std::vector<SolidCore> cores = cores_of(solid);
  for (int l = 0; l < b.used; ++l) {
    if (b.moves[std::size_t(l)] == 0) continue;
    const double travel = max_travel(b, e, l, seconds);
    find_solid_features(b, l, cores,
                        {core_radius(solid) + thickness,
                         travel / seconds,
                         travel,
                         {glm::vec3(e.lo.x[l], e.lo.y[l], e.lo.z[l]), glm::vec3(e.hi.x[l], e.hi.y[l], e.hi.z[l])}});
  }
}

double Dynamics::max_travel(const Batch& b, const Extent& e, int lane, double seconds) const {
  const double fall = glm::length(scene_.gravity) * seconds;
  return (2 * std::sqrt(double(e.length2[lane])) + fall) * seconds + 0.1 * b.model->radius +
         b.model->material.thickness;
}

}  // namespace softbody
