#include "softbody/state/state.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "softbody/state/kernels.h"
#include "softbody/state/rigid_motion.h"

namespace softbody {

/// Returns a batch of the model with a free lane. The first batch of a model grows with its bodies: one large body
/// takes, as measured, 1.3 (2,562 vertices) to 1.6 times (50,000) as long in eight lanes as alone. Two bodies already
/// take 1.4 times as long apart as in lanes.
Batch& State::batch_with_free_lane(const std::shared_ptr<const BodyModel>& model) {
  bool alone = true;
  for (Batch& b : batches_) {
    if (b.model != model) continue;
    if (b.used == b.width && b.width < lanes) widen(b);
    if (b.used < b.width) return b;
    alone = false;
  }
  Batch b;
  b.model = model;
  b.index = static_cast<Index>(batches_.size());
  b.width = alone ? one_lane : lanes;
  b.base = append(b.values());
  return batches_.emplace_back(std::move(b));
}

/// Adds room for `values` more to every array. Returns where it starts.
std::size_t State::append(std::size_t values) {
  const std::size_t base = (x[0].size() + lanes - 1) / lanes * lanes;  // where vectors are aligned
  for (auto* array : {&x, &v, &f})
    for (auto& c : *array) c.resize(base + values, 0.0f);
  return base;
}

/// Gives a full batch more lanes. Its old room lies idle, unless it is the last, which grows where it is.
void State::widen(Batch& b) {
  const std::size_t from = b.base, width = std::size_t(b.width), wider = std::size_t(next_width(b.width));
  const bool last = from + b.values() == x[0].size();
  b.width = int(wider);
  b.base = last ? from : append(b.values());
  for (auto* array : {&x, &v, &f})
    for (auto& c : *array) {
      if (last) c.resize(from + b.values());
      for (std::size_t i = b.particles(); i-- > 0;)  // from the end, since the rows may move within their own room
        for (std::size_t l = wider; l-- > 0;) c[b.base + i * wider + l] = l < width ? c[from + i * width + l] : 0.0f;
    }
}

BodyId State::add(const std::shared_ptr<const BodyModel>& model, const glm::dvec3& position, const glm::dvec3& velocity,
                  const glm::dmat3& axes, const glm::dvec3& spin) {
  Batch& batch = batch_with_free_lane(model);
  const BodyId id = body_count();
  const std::uint32_t number = bodies_.empty() ? 0 : bodies_.back().number + 1;  // numbers ascend
  const Body& body = bodies_.emplace_back(Body{{.number = number, .origin = position}, batch.index, batch.used++});
  batch.body[std::size_t(body.lane)] = id;
  const std::vector<glm::dvec3> start = turned(model->start, axes);
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& place : start) middle += place / double(start.size());
  for (Index i = 0; i < batch.particles(); ++i) {
    field_of(id, x).set(i, start[i]);
    field_of(id, v).set(i, velocity + glm::cross(spin, start[i] - middle));
  }
  update_moves(body);
  return id;
}

/// Moves everything that a batch holds in one lane to another; the lane that it leaves is empty.
void State::move_lane(Batch& b, int from, int to) {
  const auto move = [=](float* values) {
    values[to] = values[from];
    values[from] = 0.0f;  // last, since both may be the same
  };
  for (auto* array : {&x, &v, &f})
    for (auto& c : *array)
      for (std::size_t i = 0; i < b.values(); i += std::size_t(b.width)) move(c.data() + b.base + i);
  move(b.moves.data());
  const BodyId body = b.body[std::size_t(to)] = b.body[std::size_t(from)];
  bodies_[body].lane = to;
}

void State::remove(BodyId id) {
  Batch& batch = batches_[bodies_[id].batch];
  move_lane(batch, --batch.used, bodies_[id].lane);
  bodies_.erase(bodies_.begin() + std::ptrdiff_t(id));
  for (Batch& b : batches_)
    for (BodyId& body : b.body) body -= body > id;
}

void State::replace(const std::shared_ptr<const BodyModel>& from, const std::shared_ptr<const BodyModel>& to) {
  for (Batch& b : batches_)
    if (b.model == from) b.model = to;
}

void State::update_moves(const Body& body) {
  batches_[body.batch].moves[std::size_t(body.lane)] = body.moves() ? 1.0f : 0.0f;
}

void State::set_pinned(BodyId id, bool pinned) {
  bodies_[id].pinned = pinned;
  update_moves(bodies_[id]);
}

void State::set_asleep(BodyId id, bool asleep) {
  Body& body = bodies_[id];
  body.asleep = asleep;
  body.memory.calm_frames = 0;
  body.memory.impact = {};
  update_moves(body);
  if (!asleep) return;
  for (Index i = 0; i < model(id).mesh.vertices.size(); ++i) field_of(id, v).set(i, glm::dvec3(0.0));
}

void State::set_particles(BodyId id, std::span<const Particle> particles) {
  assert(particles.size() == model(id).mesh.vertices.size());
  Body& body = bodies_[id];
  glm::dvec3 middle(0.0);
  for (const Particle& p : particles) middle += p.position / double(particles.size());
  body.origin = glm::round(middle * 64.0) / 64.0;  // a multiple of 1/64 m, as in recentre()
  for (std::size_t i = 0; i < particles.size(); ++i) {
    field_of(id, x).set(i, particles[i].position - body.origin);
    field_of(id, v).set(i, particles[i].velocity);
  }
}

/// The origin moves when the first particle, which starts no further than the radius from it, is further than one and a
/// half radii away. It moves by a multiple of 1/64 m, which floats of that size hold without loss: rounding further out
/// would keep stiff bodies trembling.
void State::recentre(const Batch& b) {
  for (std::size_t l = 0; l < std::size_t(b.used); ++l) {
    const BodyField at{field(x, b.base), l, std::size_t(b.width)};
    const glm::dvec3 away = at(0);
    if (b.moves[l] <= 0 || glm::length(away) <= 1.5 * b.model->radius) continue;
    const glm::dvec3 shift = glm::round(away * 64.0) / 64.0;
    bodies_[b.body[l]].origin += shift;
    for (std::size_t i = 0; i < b.particles(); ++i) at.add(i, -shift);
  }
}

Extent State::extent(const Batch& b, const VectorArray& boxed, const VectorArray& measured) const {
  Extent e{};
  state_kernels(b.width).extent(std::size_t(b.used), b.particles(), field(boxed, b.base), field(measured, b.base), e);
  return e;
}

std::size_t State::particle_count() const {
  std::size_t count = 0;
  for (const Batch& b : batches_) count += b.particles() * std::size_t(b.used);
  return count;
}

Particle State::particle(BodyId id, Index vertex) const {
  const std::size_t s = slot(id, vertex);
  return {bodies_[id].origin + glm::dvec3(read(field(x), s)), glm::dvec3(read(field(v), s))};
}

std::array<double, lanes> State::max_particle_speeds(const Batch& b) const {
  const Extent e = extent(b, v, v);
  std::array<double, lanes> speeds{};
  for (std::size_t l = 0; l < std::size_t(b.used); ++l)
    speeds[l] = std::isfinite(e.sum2[l]) ? e.length(l) : std::numeric_limits<double>::infinity();
  return speeds;
}

namespace {

void unpack(const Batch& b, const VectorArray& array, const DoubleLaneVector& offset, std::span<const Index> first,
            Field<float> to) {
  std::array<std::size_t, lanes> starts;
  for (std::size_t l = 0; l < std::size_t(b.used); ++l) starts[l] = first[b.body[l]];
  state_kernels(b.width).unpack(std::size_t(b.used), b.particles(), field(array, b.base), offset, starts.data(), to);
}

}  // namespace

void State::write_positions(const Batch& b, std::span<const Index> first, Field<float> to) const {
  DoubleLaneVector origins{};
  for (std::size_t l = 0; l < std::size_t(b.used); ++l) origins.set(l, bodies_[b.body[l]].origin);
  unpack(b, x, origins, first, to);
}

void State::write_velocities(const Batch& b, std::span<const Index> first, Field<float> to) const {
  unpack(b, v, {}, first, to);
}

std::uint64_t State::hash() const {
  std::uint64_t h = 0xcbf29ce484222325u;
  const auto mix = [&h](std::uint64_t bits) { h = (h ^ bits) * 0x100000001b3u; };
  for (BodyId id = 0; id < body_count(); ++id) {
    for (int k = 0; k < 3; ++k) mix(std::bit_cast<std::uint64_t>(bodies_[id].origin[k]));
    for (Index i = 0; i < batch_of(id).particles(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        mix(std::bit_cast<std::uint32_t>(x[k][slot(id, i)]));
        mix(std::bit_cast<std::uint32_t>(v[k][slot(id, i)]));
      }
  }
  return h;
}

State State::saved() const {
  State copy;
  copy.x = x;
  copy.v = v;
  copy.ledger = ledger;
  copy.batches_ = batches_;
  copy.bodies_ = bodies_;
  return copy;
}

void State::restore(const State& saved) {
  *this = saved;
  for (auto& c : f) c.resize(x[0].size());
}

std::size_t State::bytes() const {
  std::size_t sum = bytes_of(batches_) + bytes_of(bodies_);
  for (const Body& body : bodies_)
    for (const HeldVertices& hold : body.memory.holds) sum += bytes_of(hold.vertices);
  for (const auto* array : {&x, &v, &f})
    for (const auto& c : *array) sum += bytes_of(c);
  return sum;
}

}  // namespace softbody
