#include "softbody/forces/hand.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace softbody {
void Hand::add(const ForceBatch& b) {
  if (!holds(b.state, b.batch)) return;
  const BodyField v = b.state.field_of(grab_->body, b.state.v);
  const BodyField f{b.f, std::size_t(b.state.body(grab_->body).lane), std::size_t(b.batch.width)};
  const double h_over_mass = b.h / b.batch.model->particle_mass;
  glm::dvec3 velocity = b.h * b.gravity;
  for (int i = 0; i < 3; ++i) {
    const std::size_t corner = grab_->corners[std::size_t(i)];
    velocity += grab_->weights[i] * (v(corner) + h_over_mass * f(corner));
  }
  exerted_ = force(b, velocity);
  for (int i = 0; i < 3; ++i) f.add(grab_->corners[std::size_t(i)], grab_->weights[i] * exerted_);
}

void Hand::kick(const ForceBatch& b) {
  if (!holds(b.state, b.batch)) return;
  const BodyField v = b.state.field_of(grab_->body, b.state.v);
  glm::dvec3 velocity(0.0);
  for (int i = 0; i < 3; ++i) velocity += grab_->weights[i] * v(grab_->corners[std::size_t(i)]);
  exerted_ = force(b, velocity);
  const glm::dvec3 change = b.h / b.batch.model->particle_mass * exerted_;
  for (int i = 0; i < 3; ++i) v.add(grab_->corners[std::size_t(i)], grab_->weights[i] * change);
}

void Hand::take(const std::optional<Grab>& grab) {
  assert(!grab || std::abs(grab->weights.x + grab->weights.y + grab->weights.z - 1) < 1e-6);
  grab_ = grab;
}

void Hand::remove(BodyId body) {
  if (holds(body)) grab_.reset();
  if (grab_ && grab_->body > body) --grab_->body;
}

glm::dvec3 Hand::point(State& state) const {
  const BodyField x = state.field_of(grab_->body, state.x);
  const glm::dvec3 origin = state.body(grab_->body).origin;
  glm::dvec3 point(0.0);
  for (int i = 0; i < 3; ++i) point += grab_->weights[i] * (origin + x(grab_->corners[std::size_t(i)]));
  return point;
}

/// Returns the force (N) on the point, which everything else would let go at `velocity` after the step.
glm::dvec3 Hand::force(const ForceBatch& b, const glm::dvec3& velocity) const {
  assert(b.h > 0);
  const BodyModel& model = *b.batch.model;
  const double rate = 2 * std::numbers::pi * grab_->frequency, mass = model.material[Material::mass];  // 1/s, kg
  const double point_mass = model.particle_mass / glm::dot(grab_->weights, grab_->weights);
  return pull(mass * rate * rate, 2 * grab_->damping_ratio * mass * rate, point_mass, b.h,
              grab_->target - point(b.state), velocity);
}

void Hand::note_point(State& state) {
  noted_point_ = point(state);
  exerted_ = glm::dvec3(0.0);
}

/// By the force last exerted, not by the one that it would have now: contacts act after the hand, so the point may move
/// otherwise than the force was found for. To first order in the step, where an integrator takes several forces.
void Hand::book_work(State& state) const {
  state.ledger.book(WorkBy::hand, glm::dot(exerted_, point(state) - noted_point_));
}

}  // namespace softbody
