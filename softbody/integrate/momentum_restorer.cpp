#include "softbody/integrate/momentum_restorer.h"

#include "softbody/state/kernels.h"
#include "softbody/state/rigid_motion.h"

namespace softbody {
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
      change.set(l, 1, push, turn, after.centre);
    }
    state_kernels(b.width).change_rigidly(b.used, b.particles(), change, view.x, view.v);
  }
}

}  // namespace softbody
