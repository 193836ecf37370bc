// Dynamics: the hand that pulls a body.

#include "softbody/forces/grab.h"

#include <numbers>

#include <glm/geometric.hpp>

#include "softbody/integrate/dynamics.h"

namespace softbody {

void Dynamics::grab(const std::optional<Grab>& grab) { grab_ = grab; }

glm::dvec3 Dynamics::grabbed_point() const {
  glm::dvec3 point(0.0);
  for (int i = 0; i < 3; ++i)
    point += grab_->weights[i] * particle(grab_->body, grab_->corners[std::size_t(i)]).position;
  return point;
}

bool Dynamics::is_grabbed(const Batch& b) const { return &batches_[bodies_[grab_->body].batch] == &b; }

/// The force on the point, which everything else would let go at `velocity` after a step of h.
glm::dvec3 Dynamics::grab_pull(const BodyModel& p, float h, const glm::dvec3& velocity) const {
  const double rate = 2 * std::numbers::pi * grab_->frequency, mass = p.material[Material::mass];  // 1/s, kg
  const double point_mass = p.particle_mass / glm::dot(grab_->weights, grab_->weights);
  return softbody::pull(mass * rate * rate, 2 * grab_->damping_ratio * mass * rate, point_mass, double(h),
                        grab_->target - grabbed_point(), velocity);
}

void Dynamics::grab_force(Batch& b) {
  if (!is_grabbed(b)) return;
  const Body& body = bodies_[grab_->body];
  const double h_over_mass = double(step_) / b.model->particle_mass;
  glm::dvec3 velocity = double(step_) * scene_.gravity;
  for (int i = 0; i < 3; ++i) {
    const std::size_t s = slot(body, grab_->corners[std::size_t(i)]);
    for (int k = 0; k < 3; ++k)
      velocity[k] += grab_->weights[i] * (v_[std::size_t(k)][s] + h_over_mass * f_[std::size_t(k)][s]);
  }
  const glm::dvec3 force = grab_pull(*b.model, step_, velocity);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      f_[std::size_t(k)][slot(body, grab_->corners[std::size_t(i)])] += float(grab_->weights[i] * force[k]);
}

void Dynamics::grab_impulse(Batch& b, float h) {
  if (!is_grabbed(b)) return;
  const Body& body = bodies_[grab_->body];
  glm::dvec3 velocity(0.0);
  for (int i = 0; i < 3; ++i)
    velocity += grab_->weights[i] * particle(grab_->body, grab_->corners[std::size_t(i)]).velocity;
  const glm::dvec3 change = double(h) / b.model->particle_mass * grab_pull(*b.model, h, velocity);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      v_[std::size_t(k)][slot(body, grab_->corners[std::size_t(i)])] += float(grab_->weights[i] * change[k]);
}

}  // namespace softbody
