#include "softbody/forces/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "softbody/forces/kernels.cpp"
#include <hwy/foreach_target.h>

#include "softbody/forces/kernel_bodies.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {
namespace {

using ConstField = Field<const float>;
using Springs = std::span<const KernelSpring<float>>;
using Shape = std::span<const ShapePoint<float>>;
using Triangles = std::span<const KernelTriangle>;

/// The kernels of one width: each run of lanes on its own.
template <int width>
struct Kernels {
  using V = body::Run<float, width>;
  static constexpr std::size_t step = body::lanes_of<V>;

  static void springs(std::size_t used, Springs s, ConstField x, ConstField v, Field<float> f) {
    for (std::size_t l = 0; l < used; l += step) body::springs<V>(s, x + l, v + l, f + l);
  }
  static void project_springs(std::size_t used, const ProjectArguments& p, Springs s, ConstField x, Field<float> d) {
    for (std::size_t l = 0; l < used; l += step)
      body::project_springs<V>({p.h, p.inverse_mass, p.moves + l}, s, x + l, d + l);
  }
  static void volume(std::size_t used, Triangles t, ConstField x, float* result) {
    for (std::size_t l = 0; l < used; l += step) body::volume<V>(t, x + l, result + l);
  }
  static void medians(std::size_t used, Triangles t, ConstField x, float* largest) {
    for (std::size_t l = 0; l < used; l += step) body::medians<V>(t, x + l, largest + l);
  }
  static void stretch(std::size_t used, Springs s, ConstField a, float* sum) {
    for (std::size_t l = 0; l < used; l += step) body::stretch<V>(s, a + l, sum + l);
  }
  static void pressure(std::size_t used, Triangles t, ConstField x, const float* gauge, Field<float> f) {
    for (std::size_t l = 0; l < used; l += step) body::pressure<V>(t, x + l, gauge + l, f + l);
  }
  static void shape_moments(std::size_t used, Shape s, ConstField x, ShapeMoments<float>& m) {
    for (std::size_t l = 0; l < used; l += step) body::shape_moments<V, width>(s, x + l, m, l);
  }
  static void shape_pull(std::size_t used, Shape s, const ShapePose<float>& p, float k, ConstField x, Field<float> f) {
    for (std::size_t l = 0; l < used; l += step) body::shape_pull<V, width>(s, p, k, x + l, f + l, l);
  }
  static constexpr ForceKernels table{springs, project_springs, volume,        medians,
                                      stretch, pressure,        shape_moments, shape_pull};
};

const ForceKernels& Table(int width) {
  return with_width(width, [](auto w) -> const ForceKernels& { return Kernels<w>::table; });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody {

HWY_EXPORT(Table);

const ForceKernels& force_kernels(int width) { return HWY_DYNAMIC_DISPATCH(Table)(width); }

}  // namespace softbody
#endif  // HWY_ONCE
