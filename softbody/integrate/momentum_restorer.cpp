#include "softbody/integrate/momentum_restorer.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "softbody/state/kernels.h"
#include "softbody/state/rigid_motion.h"

namespace softbody {
namespace {

/// Of a lane's body, but for its spin; its centre is seen from the first particle.
RigidMotion rigid_motion(const RigidSums& sums, std::size_t lane, double count) {
  RigidMotion m;
  m.centre = sums.place[lane] / count;
  m.velocity = sums.velocity[lane] / count;
  m.momentum = sums.momentum[lane] - count * glm::cross(m.centre, m.velocity);
  const glm::dvec3 square = sums.square[lane], mixed = sums.mixed[lane];
  const glm::dmat3 products(square.x, mixed.z, mixed.y, mixed.z, square.y, mixed.x, mixed.y, mixed.x, square.z);
  const glm::dmat3 about = products - count * glm::outerProduct(m.centre, m.centre);
  m.inertia = glm::dmat3(about[0][0] + about[1][1] + about[2][2]) - about;
  return m;
}

}  // namespace

void MomentumRestorer::note(const BatchView& b) {
  Noted& noted = noted_.emplace_back(Noted{b, {}});
  state_kernels(b.batch.width).rigid_sums(b.batch.used, b.batch.particles(), b.x, b.v, noted.sums);
}

void MomentumRestorer::restore(const glm::dvec3& fall, bool spin, std::span<const unsigned> pushed) const {
  for (const auto& [view, sums] : noted_) {
    const Batch& b = view.batch;
    const auto count = double(b.particles());
    RigidSums now;
    state_kernels(b.width).rigid_sums(b.used, b.particles(), view.x, view.v, now);
    RigidChange change{};
    for (std::size_t l = 0; l < std::size_t(b.used); ++l) {
      if (b.moves[l] <= 0 || (pushed[b.index] >> l & 1u)) continue;
      const RigidMotion before = rigid_motion(sums, l, count), after = rigid_motion(now, l, count);
      const glm::dvec3 push = before.velocity + fall - after.velocity;
      const glm::dvec3 turn = spin ? after.steady_spin_of(before.momentum - after.momentum) : glm::dvec3(0.0);
      if (!std::isfinite(glm::dot(push, push) + glm::dot(turn, turn))) continue;
      change.acts[l] = 1;
      change.push.set(l, push);
      change.spin.set(l, turn);
      change.about.set(l, after.centre);
    }
    state_kernels(b.width).add_rigid(b.used, b.particles(), change, view.x, view.v);
  }
}

}  // namespace softbody
