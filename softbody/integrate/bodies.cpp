// Dynamics: bodies join, stop, end a frame and are read.

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "softbody/integrate/dynamics.h"

namespace softbody {
/// The only large body of a model is solved by itself: in eight lanes it takes eight times the memory and, as
/// measured, 1.3 (2,562 vertices) to 1.6 times (50,000) as long. Two bodies already take 1.4 times as long apart as in
/// lanes. What implicit steps may take is never solved by itself: they want all lanes.
Batch& Dynamics::batch_with_free_lane(const std::shared_ptr<const BodyModel>& model) {
  bool alone = true;
  for (Batch& b : batches_) {
    if (b.model != model) continue;
    if (b.width == one_lane && b.used > 0) widen(b);
    if (b.used < b.width) return b;
    alone = false;
  }
  Batch b;
  b.model = model;
  b.width = alone && b.particles() > max_implicit_particles ? one_lane : lanes;
  b.base = append(b.values());
  return batches_.emplace_back(std::move(b));
}

/// Room for as many values more in every array of the state: where it starts.
std::size_t Dynamics::append(std::size_t values) {
  const std::size_t base = (x_[0].size() + lanes - 1) / lanes * lanes;  // where vectors are aligned
  for (auto* components : {&x_, &v_, &f_})
    for (auto& c : *components) c.resize(base + values, 0.0f);
  return base;
}

/// Gives a batch of one body eight lanes. What it had lies idle: an eighth more.
void Dynamics::widen(Batch& b) {
  const std::size_t from = b.base;
  b.width = lanes;
  b.base = append(b.values());
  for (auto* components : {&x_, &v_, &f_})
    for (auto& c : *components)
      for (std::size_t i = 0; i < b.particles(); ++i) c[b.base + i * lanes] = c[from + i];
  for (PenaltyPair& p : penalty_.pairs) {
    if (p.body_a == b.body[0]) p.slot_a = b.base + (p.slot_a - from) * lanes;
    if (p.body_b == b.body[0]) p.slot_b = b.base + (p.slot_b - from) * lanes;
  }
}

BodyId Dynamics::add(std::shared_ptr<const BodyModel> model, const glm::dvec3& position, const glm::dvec3& velocity) {
  Batch& batch = batch_with_free_lane(model);
  const auto id = static_cast<BodyId>(bodies_.size());
  const std::uint32_t number = bodies_.empty() ? 0 : bodies_.back().number + 1;  // they ascend
  Body& body = bodies_.emplace_back();
  body.number = number;
  body.batch = static_cast<Index>(&batch - batches_.data());
  body.lane = batch.used++;
  body.origin = position;
  batch.body[std::size_t(body.lane)] = id;
  for (Index i = 0; i < batch.particles(); ++i)
    for (int k = 0; k < 3; ++k) {
      x_[std::size_t(k)][slot(body, i)] = float(model->start[i][k]);
      v_[std::size_t(k)][slot(body, i)] = float(velocity[k]);
    }
  update_moves(body);
  return id;
}

/// All that the batch knows of one lane goes to another; the one that it leaves is empty.
void Dynamics::move_lane(Batch& b, int from, int to) {
  const auto move = [=](float* values) {
    values[to] = values[from];
    values[from] = 0.0f;  // last, for both may be the same
  };
  for (auto* components : {&x_, &v_, &f_})
    for (auto& c : *components)
      for (std::size_t i = 0; i < b.values(); i += std::size_t(b.width)) move(c.data() + b.base + i);
  for (float* values : {b.moves.data(), b.impulse.x, b.impulse.y, b.impulse.z, b.returned.data()}) move(values);
  const BodyId body = b.body[std::size_t(to)] = b.body[std::size_t(from)];
  bodies_[body].lane = to;
  for (PenaltyPair& p : penalty_.pairs) {
    if (p.body_a == body) p.slot_a = p.slot_a + std::size_t(to) - std::size_t(from);
    if (p.body_b == body) p.slot_b = p.slot_b + std::size_t(to) - std::size_t(from);
  }
}

void Dynamics::remove(BodyId id) {
  Batch& batch = batches_[bodies_[id].batch];
  move_lane(batch, --batch.used, bodies_[id].lane);
  penalty_.remove(id, vertices_->first[id], vertices_->size(id));
  surface_.clear();  // found anew in the next frame
  bodies_.erase(bodies_.begin() + std::ptrdiff_t(id));
  for (Batch& b : batches_)
    for (BodyId& body : b.body) body -= body > id;
  if (grab_ && grab_->body == id) grab_.reset();
  if (grab_ && grab_->body > id) --grab_->body;
}

void Dynamics::replace(const std::shared_ptr<const BodyModel>& from, const std::shared_ptr<const BodyModel>& to) {
  for (Batch& b : batches_)
    if (b.model == from) b.model = to;
}

void Dynamics::update_moves(const Body& body) {
  batches_[body.batch].moves[std::size_t(body.lane)] = body.moves() ? 1.0f : 0.0f;
}

void Dynamics::pin_body(BodyId id, bool pinned, int release) {
  bodies_[id].pinned = pinned;
  bodies_[id].release = release;
  update_moves(bodies_[id]);
}

void Dynamics::set_asleep(BodyId id, bool asleep) {
  Body& body = bodies_[id];
  body.asleep = asleep;
  body.calm_frames = 0;
  update_moves(body);
  if (!asleep) return;
  for (Index i = 0; i < model(id).mesh.vertices.size(); ++i)
    for (auto& c : v_) c[slot(body, i)] = 0.0f;
}

void Dynamics::set_particles(BodyId id, std::span<const Particle> particles) {
  Body& body = bodies_[id];
  glm::dvec3 middle(0.0);
  for (const Particle& p : particles) middle += p.position / double(particles.size());
  body.origin = glm::round(middle * 64.0) / 64.0;  // as recentre_origin() moves it
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const std::size_t s = slot(body, static_cast<Index>(i));
      x_[std::size_t(k)][s] = float(particles[i].position[k] - body.origin[k]);
      v_[std::size_t(k)][s] = float(particles[i].velocity[k]);
    }
}

Particle Dynamics::particle(BodyId id, Index vertex) const {
  const Body& body = bodies_[id];
  const std::size_t s = slot(body, vertex);
  return {body.origin + glm::dvec3(x_[0][s], x_[1][s], x_[2][s]), glm::dvec3(v_[0][s], v_[1][s], v_[2][s])};
}

glm::dvec3 Dynamics::solid_impulse(BodyId id) const {
  const LaneVector& j = batches_[bodies_[id].batch].impulse;
  const int lane = bodies_[id].lane;
  return {j.x[lane], j.y[lane], j.z[lane]};
}

double Dynamics::max_particle_speed(BodyId id) const {
  const Body& body = bodies_[id];
  const auto count = static_cast<Index>(model(id).mesh.vertices.size());
  double speed2 = 0;
  for (Index i = 0; i < count; ++i) {
    const std::size_t s = slot(body, i);
    const double here = double(v_[0][s]) * v_[0][s] + double(v_[1][s]) * v_[1][s] + double(v_[2][s]) * v_[2][s];
    if (!std::isfinite(here)) return std::numeric_limits<double>::infinity();  // no rest for a body that is lost
    speed2 = std::max(speed2, here);
  }
  return std::sqrt(speed2);
}

void Dynamics::world_positions(std::span<float> x, std::span<float> y, std::span<float> z) const {
  std::size_t out = 0;
  for (const Body& body : bodies_) {
    const Batch& b = batches_[body.batch];
    const std::size_t first = slot(body, 0), stride = std::size_t(b.width);
    for (std::size_t s = first; s < first + b.values(); s += stride, ++out) {
      x[out] = static_cast<float>(body.origin.x + x_[0][s]);
      y[out] = static_cast<float>(body.origin.y + x_[1][s]);
      z[out] = static_cast<float>(body.origin.z + x_[2][s]);
    }
  }
}

void Dynamics::finish_frame(double seconds) {
  for (BodyId id = 0; id < bodies_.size(); ++id) {
    Body& body = bodies_[id];
    if (!body.moves()) continue;
    const BatchView b = view(batches_[body.batch]);
    const double returned = double(b.batch.returned[std::size_t(body.lane)]);
    resistance_.apply(*b.batch.model, b.positions(body.lane), b.velocities(body.lane), {solid_impulse(id), returned},
                      seconds, body.impact);
    recentre_origin(id);
  }
}

/// Moves the body's origin when its first particle, which begins no further than the radius from it, has gone further
/// than one and a half, by a multiple of 1/64 m that floats of that size hold without loss. What is rounded off further
/// out would keep stiff bodies trembling.
void Dynamics::recentre_origin(BodyId id) {
  Body& body = bodies_[id];
  const std::size_t first = slot(body, 0);
  const glm::dvec3 away(x_[0][first], x_[1][first], x_[2][first]);
  if (glm::length(away) <= 1.5 * model(id).radius) return;
  for (int k = 0; k < 3; ++k) {
    const double shift = std::round(away[k] * 64) / 64;
    body.origin[k] += shift;
    for (Index i = 0; i < model(id).mesh.vertices.size(); ++i) x_[std::size_t(k)][slot(body, i)] -= float(shift);
  }
}

std::uint64_t Dynamics::hash() const {
  std::uint64_t h = 0xcbf29ce484222325u;
  const auto mix = [&h](std::uint64_t bits) { h = (h ^ bits) * 0x100000001b3u; };
  for (const Body& body : bodies_) {
    for (int k = 0; k < 3; ++k) mix(std::bit_cast<std::uint64_t>(body.origin[k]));
    for (Index i = 0; i < batches_[body.batch].particles(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        mix(std::bit_cast<std::uint32_t>(x_[k][slot(body, i)]));
        mix(std::bit_cast<std::uint32_t>(v_[k][slot(body, i)]));
      }
  }
  return h;
}

}  // namespace softbody
