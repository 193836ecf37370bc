#pragma once
// The kernels of forces: for the processor at hand, and for lanes or one body alone. Every variant is compiled from the
// same source without fused arithmetic, so all give the same bits.

#include <array>

#include "softbody/forces/kernel_types.h"
#include "softbody/state/isa.h"

namespace softbody {

/// In the order of the table of forces; nullptr for those that lack it.
struct ForceKernels {
  std::array<void (*)(const LaneBodies<float>&, const Moving&), force_count> add;
  std::array<void (*)(const LaneBodies<float>&, const Projection&), force_count> project;
  /// The surface of the body in each lane. f: room for dV/dx, and zero.
  void (*measure_surfaces)(const LaneBodies<float>&, SurfaceShape*);
};
const ForceKernels& force_kernels(Isa isa, int width);

/// For implicit steps, in double.
struct ImplicitForceKernels {
  void (*hold)(const LaneBodies<double>&, HeldForces&);
  void (*add)(const LaneBodies<double>&, const HeldForces&, const SinceStart&);
  void (*add_external)(const LaneBodies<double>&, const HeldForces&, const SinceStart&);  // those not internal
};
const ImplicitForceKernels& implicit_force_kernels(Isa isa);

}  // namespace softbody
