#pragma once
// The kernels of forces over one batch of bodies. Vectorised with Highway, which chooses the processor's instruction
// set at run time; the result is the same on every one.

#include <array>

#include "softbody/mechanics/kernel_types.h"

namespace softbody {

/// In the order of the table of forces; nullptr for those that lack it.
struct ForceKernels {
  std::array<void (*)(const LaneBodies<float>&, const Moving&), force_count> add;
  std::array<void (*)(const LaneBodies<float>&, const Projection&), force_count> project;
  /// Changes the velocities v by a substep of all forces, see simd::kick() and simd::press(). f: what forces without
  /// elements do, and those of offsets and paths; after it, A, or 0 if the positions have moved, too.
  void (*advance)(const LaneBodies<float>&, const KickArguments&, const Advance&, Field<float> v, LaneVolumes&);
  /// Finds the implicit pressure again, for velocities that contacts have changed since. f: A.
  void (*press_again)(const LaneBodies<float>&, const KickArguments&, Field<float> v, LaneVolumes&);
  /// Measures the surface of the body in each lane. f: room for dV/dx.
  void (*measure_surfaces)(const LaneBodies<float>&, SurfaceShape*);
  void (*measure_motion)(const MovingBodies&, MotionSums&);
};
const ForceKernels& force_kernels(int width);

/// For implicit steps, in double.
struct ImplicitForceKernels {
  void (*hold)(const LaneBodies<double>&, HeldForces&);
  void (*add)(const LaneBodies<double>&, const HeldForces&, const SinceStart&);
  void (*add_external)(const LaneBodies<double>&, const HeldForces&, const SinceStart&);  // those not internal
};
const ImplicitForceKernels& implicit_force_kernels();

}  // namespace softbody
