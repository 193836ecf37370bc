#pragma once
// Keeps the momenta of bodies in free flight from what rounding does to them.

#include <span>
#include <vector>

#include "softbody/state/kernel_types.h"
#include "softbody/state/state.h"

namespace softbody {

/// The forces of springs and gas add up to none, nor to a torque. But those of stiff bodies are large and cancel each
/// other at every particle, where floats round them: over many substeps the momenta walk at random. This gives bodies
/// that nothing has touched the momenta back that they had at the start of the frame.
class MomentumRestorer {
 public:
  /// Notes the momenta that the bodies of a batch have now. The batch and its fields must stay where they are until
  /// restore() has been called, or this is gone.
  void note(const BatchView& batch);
  /// Restores the momenta of all bodies that have been noted and move, but of those that something has pushed. pushed:
  /// of each batch of the state, a bit for each lane.
  /// The linear ones become the noted ones after a change of velocity by `fall` (m/s), which gravity makes. `spin`: the
  /// angular ones become the noted ones; else what the integrator itself does to them stays.
  void restore(const glm::dvec3& fall, bool spin, std::span<const unsigned> pushed) const;

 private:
  struct Noted {
    BatchView batch;
    RigidSums sums;
  };
  std::vector<Noted> noted_;
};

}  // namespace softbody
