#pragma once
// The inner loops over the particles of one batch: moving them, measuring them. Vectorised with Highway, which chooses
// the processor's instruction set at run time; the result is the same on every one.

#include <cstddef>

#include "softbody/state/kernel_types.h"

namespace softbody {

/// The kernels for batches of one width. `used`: lanes from the first on that hold a body; others may be left out.
struct StateKernels {
  // Plain arithmetic on fields. Lanes whose value of `moves` is 0 stay as they are.
  void (*copy)(std::size_t used, std::size_t particles, const float* moves, Field<const float> from, Field<float> to);
  void (*add)(std::size_t used, std::size_t particles, const float* moves, float times, Field<const float> a,
              Field<float> to);
  void (*scale)(std::size_t used, std::size_t particles, const float* moves, float times, Field<float> a);

  void (*kick)(std::size_t used, const KickArguments&, Field<const float> f, Field<float> v);
  void (*accelerate)(std::size_t used, const KickArguments&, Field<float> f);  // to what kick() adds
  void (*extent)(std::size_t used, std::size_t particles, Field<const float> boxed, Field<const float> measured,
                 Extent&);
  /// Writes the vectors and `offset`, one body after another: those of a lane from to + first[lane] on.
  void (*unpack)(std::size_t used, std::size_t particles, Field<const float> a, const DoubleLaneVector& offset,
                 const std::size_t* first, Field<float> to);
  void (*rigid_sums)(std::size_t used, std::size_t particles, Field<const float> x, Field<const float> v, RigidSums&);
  void (*change_rigidly)(std::size_t used, std::size_t particles, const RigidChange&, Field<const float> x,
                         Field<float> v);
};

const StateKernels& state_kernels(int width);

}  // namespace softbody
