#include "softbody/world/measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "softbody/forces/deformation.h"
#include "softbody/forces/model_forces.h"
#include "softbody/scene/solids.h"

namespace softbody {
namespace {

/// Returns the elastic and the gas energy of a body with its particles at x.
Energy deformation(const BodyModel& p, const std::vector<glm::dvec3>& x) {
  const StoredEnergy stored = stored_energy(p, x);
  Energy energy;
  energy.elastic = stored.elastic, energy.gas = stored.gas;
  return energy;
}

double largest_strain(const BodyModel& p, const std::vector<glm::dvec3>& x) {
  double most = 0;
  for_each_spring(p, [&](const Spring& s) {
    if (s.rest > 0) most = std::max(most, std::abs(glm::distance(x[s.i], x[s.j]) / s.rest - 1));
  });
  return most;
}

/// Returns BodyMeasures::staggering. deformation_now: the body's present deformation energy in J.
double staggering(const World& world, BodyId id, double substep, double deformation_now) {
  const BodyModel& p = world.model(id);
  std::vector<glm::dvec3> middle, before;  // positions in the middle of the last substep, and before it
  double sum = 0;
  for (Index i = 0; i < p.mesh.vertices.size(); ++i) {
    const Particle q = world.particle(id, i);
    middle.push_back(q.position - substep / 2 * q.velocity);
    before.push_back(q.position - substep * q.velocity);
    sum += p.particle_mass * glm::dot(world.scene().gravity, substep / 2 * q.velocity);
  }
  const auto at = [&](const std::vector<glm::dvec3>& x) { return deformation(p, x).deformation(); };
  return sum + 2 * at(middle) - (deformation_now + at(before)) / 2 - deformation_now;
}

}  // namespace

Energy& Energy::operator+=(const Energy& other) {
  kinetic += other.kinetic;
  elastic += other.elastic;
  gas += other.gas;
  gravity += other.gravity;
  return *this;
}

BodyMeasures measure(const World& world, BodyId id, double substep) {
  const BodyModel& p = world.model(id);
  const Scene& scene = world.scene();
  BodyMeasures m;
  double kinetic = 0, gravity = 0;
  std::vector<glm::dvec3> x;
  x.reserve(p.mesh.vertices.size());
  for (Index i = 0; i < p.mesh.vertices.size(); ++i) {
    const Particle q = world.particle(id, i);
    x.push_back(q.position);
    const double speed2 = glm::dot(q.velocity, q.velocity);
    m.finite = m.finite && std::isfinite(speed2) && std::isfinite(glm::dot(q.position, q.position));
    kinetic += 0.5 * p.particle_mass * speed2;
    gravity -= p.particle_mass * glm::dot(scene.gravity, q.position);
    m.momentum += p.particle_mass * q.velocity;
    m.max_speed = std::max(m.max_speed, std::sqrt(speed2));
    m.deepest_penetration = std::max(m.deepest_penetration, solid_depth(scene, q.position).depth);
  }
  m.energy = deformation(p, x);
  m.largest_strain = largest_strain(p, x);
  if (substep > 0) m.staggering = staggering(world, id, substep, m.energy.deformation());
  m.energy.kinetic = kinetic;
  m.energy.gravity = gravity;
  m.closed = p.mesh.closed;
  if (m.closed) m.volume_ratio = enclosed_volume(p, x) / p.start_volume;
  return m;
}

Energy starting_energy(const BodyModel& p) { return deformation(p, p.start); }

SolidDepth solid_depth(const Scene& scene, const glm::dvec3& point) {
  SolidDepth deepest{glm::vec3(0, 1, 0), -std::numeric_limits<double>::infinity()};
  for_each_solid(scene, [&](const auto& solid) {
    const SolidSurface s = surface_at(solid, point);
    if (-s.distance > deepest.depth) deepest = {glm::vec3(s.normal), -s.distance};
  });
  return deepest;
}

Measures total(std::span<const BodyMeasures> bodies) {
  Measures m;
  for (const BodyMeasures& b : bodies) {
    m.energies += b.energy;
    m.momentum += b.momentum;
    m.largest_strain = std::max(m.largest_strain, b.largest_strain);
    m.deepest_penetration = std::max(m.deepest_penetration, b.deepest_penetration);
    m.max_speed = std::max(m.max_speed, b.max_speed);
    m.finite = m.finite && b.finite;
    if (!b.closed) continue;
    m.volume_ratio_min = m.has_volume ? std::min(m.volume_ratio_min, b.volume_ratio) : b.volume_ratio;
    m.volume_ratio_max = m.has_volume ? std::max(m.volume_ratio_max, b.volume_ratio) : b.volume_ratio;
    m.has_volume = true;
  }
  m.energy = m.energies.total();
  return m;
}

std::vector<BodyMeasures> measure_bodies(const World& world, double substep) {
  std::vector<BodyMeasures> list;
  for (BodyId id = 0; id < world.bodies().count(); ++id) list.push_back(measure(world, id, substep));
  return list;
}

std::vector<SolidContactPoint> solid_contacts(const World& world) {
  constexpr double rounding = 1e-4;  // m: where a particle rests on a solid it keeps its thickness only up to rounding
  std::vector<SolidContactPoint> contacts;
  const collide::Frame p = world.positions();
  for (BodyId body = 0; body < p.bodies->count(); ++body) {
    const double distance = world.model(body).material[Material::thickness] + rounding;
    for (Index i = p.bodies->first[body]; i < p.bodies->first[body + 1]; ++i) {
      const SolidDepth d = solid_depth(world.scene(), {p.x[i], p.y[i], p.z[i]});
      if (d.depth > -distance) contacts.push_back({i, d.normal});
    }
  }
  return contacts;
}

Measures measure(const World& world) { return total(measure_bodies(world)); }

}  // namespace softbody
