#include "softbody/forces/hand.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace softbody {
namespace {

/// f: where its forces are read or added.
HeldBody held_body(State& s, BodyId id, const BodyField& f = {}) {
  return {s.model(id), s.body(id).origin, s.field_of(id, s.x), s.field_of(id, s.v), f};
}

}  // namespace

void Hand::add(const ForceBatch& b) const {
  if (!holds(b.state, b.batch)) return;
  const BodyField f{b.f, std::size_t(b.state.body(grab_->body).lane), std::size_t(b.batch.width)};
  add_force(held_body(b.state, grab_->body, f), b.h, b.gravity);
}

void Hand::kick(const ForceBatch& b) const {
  if (holds(b.state, b.batch)) add_impulse(held_body(b.state, grab_->body), b.h);
}

void Hand::take(const std::optional<Grab>& grab) {
  assert(!grab || std::abs(grab->weights.x + grab->weights.y + grab->weights.z - 1) < 1e-6);
  grab_ = grab;
}

void Hand::remove(BodyId body) {
  if (holds(body)) grab_.reset();
  if (grab_ && grab_->body > body) --grab_->body;
}

glm::dvec3 Hand::point(const HeldBody& body) const {
  glm::dvec3 point(0.0);
  for (int i = 0; i < 3; ++i) point += grab_->weights[i] * (body.origin + body.x(grab_->corners[std::size_t(i)]));
  return point;
}

/// On the point, which everything else would let go at `velocity` after a step of h.
glm::dvec3 Hand::force(const HeldBody& body, double h, const glm::dvec3& velocity) const {
  const double rate = 2 * std::numbers::pi * grab_->frequency, mass = body.model.material[Material::mass];  // 1/s, kg
  const double point_mass = body.model.particle_mass / glm::dot(grab_->weights, grab_->weights);
  return pull(mass * rate * rate, 2 * grab_->damping_ratio * mass * rate, point_mass, h, grab_->target - point(body),
              velocity);
}

void Hand::note_point(State& state) {
  noted_point_ = point(held_body(state, grab_->body));
  exerted_ = glm::dvec3(0.0);
}

/// By the force last exerted, not by the one that it would have now: contacts act after the hand, so the point may move
/// otherwise than the force was found for. To first order in the step, where an integrator takes several forces.
void Hand::book_work(State& state) const {
  state.ledger.book(WorkBy::hand, glm::dot(exerted_, point(held_body(state, grab_->body)) - noted_point_));
}

void Hand::add_force(const HeldBody& body, double h, const glm::dvec3& gravity) const {
  assert(grab_ && h > 0);
  const double h_over_mass = h / body.model.particle_mass;
  glm::dvec3 velocity = h * gravity;
  for (int i = 0; i < 3; ++i) {
    const std::size_t corner = grab_->corners[std::size_t(i)];
    velocity += grab_->weights[i] * (body.v(corner) + h_over_mass * body.f(corner));
  }
  exerted_ = force(body, h, velocity);
  for (int i = 0; i < 3; ++i) body.f.add(grab_->corners[std::size_t(i)], grab_->weights[i] * exerted_);
}

void Hand::add_impulse(const HeldBody& body, double h) const {
  assert(grab_ && h > 0);
  glm::dvec3 velocity(0.0);
  for (int i = 0; i < 3; ++i) velocity += grab_->weights[i] * body.v(grab_->corners[std::size_t(i)]);
  exerted_ = force(body, h, velocity);
  const glm::dvec3 change = h / body.model.particle_mass * exerted_;
  for (int i = 0; i < 3; ++i) body.v.add(grab_->corners[std::size_t(i)], grab_->weights[i] * change);
}

}  // namespace softbody
