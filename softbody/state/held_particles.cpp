#include "softbody/state/held_particles.h"

#include <algorithm>
#include <utility>

#include "softbody/state/rigid_motion.h"
#include "softbody/state/state.h"

namespace softbody {

std::span<const HeldParticle> HeldParticles::of(const Batch& b) const {
  return b.index < of_batch_.size() ? std::span<const HeldParticle>(of_batch_[b.index].particles)
                                    : std::span<const HeldParticle>();
}

std::span<const char> HeldParticles::of(BodyId body) const {
  return body < of_body_.size() ? std::span<const char>(of_body_[body]) : std::span<const char>();
}

bool HeldParticles::moves(const Batch& b) const { return b.index < of_batch_.size() && of_batch_[b.index].moves; }

const float* HeldParticles::free(const Batch& b) const { return any(b) ? of_batch_[b.index].free.data() : nullptr; }

void HeldParticles::begin_frame(State& state) {
  *this = {};
  for (BodyId id = 0; id < state.body_count(); ++id) {
    if (std::ranges::none_of(state.memory(id).holds, &HeldVertices::on) || !state.body(id).moves()) continue;
    of_batch_.resize(state.batches().size());
    of_body_.resize(state.body_count());
    const Batch& b = state.batch_of(id);
    OfBatch& own = of_batch_[b.index];
    own.free.resize(b.values(), 1.0f);
    of_body_[id].resize(b.particles());
    for (std::uint32_t hold = 0; const HeldVertices& h : state.memory(id).holds) {
      for (const Index vertex : h.vertices) {
        if (!h.on || std::exchange(of_body_[id][vertex], 1)) continue;
        const auto slot = std::uint32_t(state.slot(id, vertex));
        own.particles.push_back({slot, id, hold});
        own.free[slot - b.base] = 0;
      }
      own.moves = own.moves || (h.on && h.moves());
      if (h.on && h.moves()) state.memory(id).calm_frames = 0;  // it is not to fall asleep
      ++hold;
    }
    moves_ = moves_ || own.moves;
  }
  constexpr float instant = 1e-6f;  // s
  const auto kinetic = [&](const HeldParticle& p, const Batch& b) {
    const glm::dvec3 v(read(field(std::as_const(state.v)), p.slot));
    return b.model->particle_mass / 2 * glm::dot(v, v);
  };
  for (const Batch& b : state.batches()) {
    if (!any(b)) continue;
    for (const HeldParticle& p : of(b)) of_batch_[b.index].work -= kinetic(p, b);
    begin_substep(state, b, instant);
    for (const HeldParticle& p : of(b)) of_batch_[b.index].work += kinetic(p, b);
  }
}

void HeldParticles::begin_substep(State& state, const Batch& b, float h) {
  if (b.index >= of_batch_.size()) return;
  OfBatch& own = of_batch_[b.index];
  const Field<const float> x = field(std::as_const(state.x));
  glm::dmat3 turn(1.0);
  const HeldVertices* last = nullptr;
  for (HeldParticle& p : own.particles) {
    const HeldVertices& hold = state.memory(p.body).holds[p.hold];
    if (!hold.moves()) continue;
    if (std::exchange(last, &hold) != &hold) turn = rotation(double(h) * hold.spin) - glm::dmat3(1.0);
    const glm::dvec3 out = state.body(p.body).origin - hold.through + glm::dvec3(read(x, p.slot));
    p.velocity = glm::vec3(hold.velocity + turn * out / double(h));
  }
  impose(b, field(state.v));
}

void HeldParticles::impose(const Batch& b, Field<float> v) const {
  for (const HeldParticle& p : of(b))
    v.x[p.slot] = p.velocity.x, v.y[p.slot] = p.velocity.y, v.z[p.slot] = p.velocity.z;
}

void HeldParticles::end_substep(State& state, const Batch& b, Field<const float> f, const glm::dvec3& gravity,
                                float h) {
  OfBatch& own = of_batch_[b.index];
  const double mass = b.model->particle_mass;
  const HeldVertices* last = nullptr;
  for (const HeldParticle& p : own.particles) {
    const glm::dvec3 pull = glm::dvec3(read(f, p.slot - b.base)) + mass * gravity;
    own.work -= double(h) * glm::dot(pull, glm::dvec3(p.velocity));
    HeldVertices& hold = state.memory(p.body).holds[p.hold];
    if (std::exchange(last, &hold) != &hold) hold.through += double(h) * hold.velocity;
  }
}

double HeldParticles::take_work() {
  double sum = 0;
  for (OfBatch& own : of_batch_) sum += std::exchange(own.work, 0.0);
  return sum;
}

}  // namespace softbody
