#include "softbody/forces/hand.h"

#include <numbers>

#include <glm/geometric.hpp>

namespace softbody {

/// Returns the force on the point, which everything else would let go at `velocity` after the step.
glm::dvec3 Hand::force(const ForceBatch& b, const glm::dvec3& velocity) const {
  const double rate = 2 * std::numbers::pi * grab->frequency, mass = b.model.material[Material::mass];  // 1/s, kg
  const double point_mass = b.model.particle_mass / glm::dot(grab->weights, grab->weights);
  return pull(mass * rate * rate, 2 * grab->damping_ratio * mass * rate, point_mass, double(b.h),
              grab->target - b.held->position, velocity);
}

void Hand::add(const ForceBatch& b) const {
  if (!b.held) return;
  const double h_over_mass = double(b.h) / b.model.particle_mass;
  glm::dvec3 velocity = double(b.h) * b.gravity;
  for (std::size_t i = 0; i < 3; ++i)
    velocity += grab->weights[int(i)] *
                (glm::dvec3(read(b.v, b.held->corners[i])) + h_over_mass * glm::dvec3(read(b.f, b.held->corners[i])));
  const glm::dvec3 by_hand = force(b, velocity);
  for (std::size_t i = 0; i < 3; ++i)
    softbody::add(b.f, b.held->corners[i], glm::vec3(grab->weights[int(i)] * by_hand));
}

void Hand::kick(const ForceBatch& b) const {
  if (!b.held) return;
  glm::dvec3 velocity(0.0);
  for (std::size_t i = 0; i < 3; ++i) velocity += grab->weights[int(i)] * glm::dvec3(read(b.v, b.held->corners[i]));
  const glm::dvec3 change = double(b.h) / b.model.particle_mass * force(b, velocity);
  for (std::size_t i = 0; i < 3; ++i) softbody::add(b.v, b.held->corners[i], glm::vec3(grab->weights[int(i)] * change));
}

}  // namespace softbody
