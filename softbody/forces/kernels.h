#pragma once
// The inner loops of forces over one batch of bodies. Vectorised with Highway, which chooses the processor's
// instruction set at run time; the result is the same on every one.

#include <cstddef>
#include <span>

#include "softbody/forces/kernel_types.h"

namespace softbody {

/// For batches of one width. `used`: lanes from the first on that hold a body; others may be left out.
struct ForceKernels {
  void (*springs)(std::size_t used, std::span<const KernelSpring<float>>, Field<const float> x, Field<const float> v,
                  Field<float> f);
  void (*project_springs)(std::size_t used, const ProjectArguments&, std::span<const KernelSpring<float>>,
                          Field<const float> x, Field<float> d);
  void (*volume)(std::size_t used, std::span<const KernelTriangle>, Field<const float> x, float* volume);
  void (*medians)(std::size_t used, std::span<const KernelTriangle>, Field<const float> x, float* largest);
  void (*stretch)(std::size_t used, std::span<const KernelSpring<float>>, Field<const float> a, float* sum);
  void (*pressure)(std::size_t used, std::span<const KernelTriangle>, Field<const float> x, const float* gauge_pressure,
                   Field<float> f);
  void (*shape_moments)(std::size_t used, std::span<const ShapePoint<float>>, Field<const float> x,
                        ShapeMoments<float>&);
  void (*shape_pull)(std::size_t used, std::span<const ShapePoint<float>>, const ShapePose<float>&, float stiffness,
                     Field<const float> x, Field<float> f);
};

const ForceKernels& force_kernels(int width);

}  // namespace softbody
