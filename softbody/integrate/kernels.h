#pragma once
// The inner loops of a substep over one batch of bodies, chosen for its width and for the processor at hand. Every
// variant is compiled from the same source without fused arithmetic, so all give the same bits.

#include <cstddef>

#include "softbody/contact/solid_law.h"
#include "softbody/state/isa.h"
#include "softbody/state/kernel_types.h"

namespace softbody {

/// For batches of one width.
struct Kernels {
  void (*kick)(const KickArguments&, Field<const float> f, Field<float> v);
  unsigned (*solid)(const SolidArguments&, Field<const float> x, Field<float> v);  // the lanes it acted in, as bits
  void (*drift)(std::size_t particles, float h, const float* moves, Field<const float> v, Field<float> x);
  void (*extent)(std::size_t particles, Field<const float> boxed, Field<const float> measured, Extent&);
  void (*rigid_sums)(std::size_t particles, Field<const float> x, Field<const float> v, RigidSums&);
  void (*add_rigid)(std::size_t particles, const RigidChange&, Field<const float> x, Field<float> v);
};

const Kernels& kernels(Isa isa, int width = lanes);

}  // namespace softbody
