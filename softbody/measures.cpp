#include "softbody/measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "softbody/shape_matching.h"
#include "softbody/solids.h"

namespace softbody {
namespace {

double spring_energy(const std::vector<Spring>& springs, const std::vector<Particle>& particles) {
  double energy = 0;
  for (const Spring& s : springs) {
    const double stretch = glm::distance(particles[s.i].position, particles[s.j].position) - s.rest;
    energy += 0.5 * s.stiffness * stretch * stretch;
  }
  return energy;
}

double volume_of(const std::vector<Particle>& particles, const std::vector<Triangle>& triangles) {
  const glm::dvec3 origin = particles.front().position;  // any point will do; a near one loses no digits
  double six = 0;
  for (const auto& [a, b, c] : triangles)
    six += glm::dot(particles[a].position - origin,
                    glm::cross(particles[b].position - origin, particles[c].position - origin));
  return six / 6;
}

std::vector<glm::dvec3> positions(const std::vector<Particle>& particles) {
  std::vector<glm::dvec3> list;
  for (const Particle& q : particles) list.push_back(q.position);
  return list;
}

/// Adds one body to the totals.
void add_body(const World& world, BodyId id, Measures& m) {
  const Prototype& p = world.prototype(id);
  const Scene& scene = world.scene();
  std::vector<Particle> particles;
  for (Index i = 0; i < p.mesh.vertices.size(); ++i) particles.push_back(world.dynamics().particle(id, i));
  for (const Particle& q : particles) {
    const double speed2 = glm::dot(q.velocity, q.velocity);
    m.finite = m.finite && std::isfinite(speed2) && std::isfinite(glm::dot(q.position, q.position));
    m.energy += p.particle_mass * (0.5 * speed2 - glm::dot(scene.gravity, q.position));
    m.momentum += p.particle_mass * q.velocity;
    m.max_speed = std::max(m.max_speed, std::sqrt(speed2));
    m.deepest_penetration = std::max(m.deepest_penetration, solid_depth(scene, q.position).depth);
  }
  for (const auto* springs : {&p.structural, &p.bend, &p.shear}) m.energy += spring_energy(*springs, particles);
  if (p.shape_rate > 0) m.energy += shape_energy(p, positions(particles));
  if (!p.mesh.closed) return;
  const double volume = volume_of(particles, p.mesh.triangles);
  if (p.has_gas) m.energy += p.gas.energy(volume);
  const double ratio = volume / p.start_volume;
  m.volume_ratio_min = m.has_volume ? std::min(m.volume_ratio_min, ratio) : ratio;
  m.volume_ratio_max = m.has_volume ? std::max(m.volume_ratio_max, ratio) : ratio;
  m.has_volume = true;
}

}  // namespace

SolidDepth solid_depth(const Scene& scene, const glm::dvec3& point) {
  SolidDepth deepest{glm::vec3(0, 1, 0), -std::numeric_limits<double>::infinity()};
  for_each_solid(scene, [&](const auto& solid) {
    const SolidSurface s = surface_at(solid, point);
    if (-s.distance > deepest.depth) deepest = {glm::vec3(s.normal), -s.distance};
  });
  return deepest;
}

Measures measure(const World& world) {
  Measures m;
  for (BodyId id = 0; id < world.bodies().count(); ++id) add_body(world, id, m);
  return m;
}

}  // namespace softbody
