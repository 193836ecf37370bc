#include "softbody/forces/hand.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace softbody {

void Hand::take(const std::optional<Grab>& grab) {
  assert(!grab || std::abs(grab->weights.x + grab->weights.y + grab->weights.z - 1) < 1e-6);
  grab_ = grab;
}

void Hand::remove(BodyId body) {
  if (holds(body)) grab_.reset();
  if (grab_ && grab_->body > body) --grab_->body;
}

/// Returns the force on the point, which everything else would let go at `velocity` after the step.
glm::dvec3 Hand::force(const ForceBatch& b, const glm::dvec3& velocity) const {
  const BodyModel& p = *b.batch.model;
  const double rate = 2 * std::numbers::pi * grab_->frequency, mass = p.material[Material::mass];  // 1/s, kg
  const double point_mass = p.particle_mass / glm::dot(grab_->weights, grab_->weights);
  glm::dvec3 point(0.0);
  for (int i = 0; i < 3; ++i)
    point += grab_->weights[i] * b.state.particle(grab_->body, grab_->corners[std::size_t(i)]).position;
  return pull(mass * rate * rate, 2 * grab_->damping_ratio * mass * rate, point_mass, b.h, grab_->target - point,
              velocity);
}

void Hand::add(const ForceBatch& b) const {
  if (!pulls(b)) return;
  assert(b.h > 0);
  const BodyField v = b.state.field_of(grab_->body, b.state.v), f = b.state.field_of(grab_->body, b.state.f);
  const double h_over_mass = b.h / b.batch.model->particle_mass;
  glm::dvec3 velocity = b.h * b.gravity;
  for (int i = 0; i < 3; ++i) {
    const std::size_t corner = grab_->corners[std::size_t(i)];
    velocity += grab_->weights[i] * (v(corner) + h_over_mass * f(corner));
  }
  const glm::dvec3 pulled = force(b, velocity);
  for (int i = 0; i < 3; ++i) f.add(grab_->corners[std::size_t(i)], grab_->weights[i] * pulled);
}

void Hand::kick(const ForceBatch& b) const {
  if (!pulls(b)) return;
  assert(b.h > 0);
  const BodyField v = b.state.field_of(grab_->body, b.state.v);
  glm::dvec3 velocity(0.0);
  for (int i = 0; i < 3; ++i) velocity += grab_->weights[i] * v(grab_->corners[std::size_t(i)]);
  const glm::dvec3 change = b.h / b.batch.model->particle_mass * force(b, velocity);
  for (int i = 0; i < 3; ++i) v.add(grab_->corners[std::size_t(i)], grab_->weights[i] * change);
}

}  // namespace softbody
