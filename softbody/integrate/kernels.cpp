#include "softbody/integrate/kernels.h"

#include "softbody/contact/solid_kernel.h"
#include "softbody/forces/kernel_bodies.h"

namespace softbody {
namespace {

using ConstField = Field<const float>;
using Springs = std::span<const KernelSpring<float>>;
using Shape = std::span<const ShapePoint<float>>;
using Triangles = std::span<const KernelTriangle>;

// One table an instruction set and width. The bodies are inlined into functions that carry the target attribute; a
// resolver of the linker (ifunc) would do the same but does not work under the sanitizers.
#define SB_KERNEL_TABLE(name, width, target)                                                                       \
  struct name {                                                                                                    \
    target static void springs(Springs s, ConstField x, ConstField v, Field<float> f) {                            \
      body::springs<float, width>(s, x, v, f);                                                                     \
    }                                                                                                              \
    target static void project_springs(const ProjectArguments& p, Springs s, ConstField start, Field<float> x) {   \
      body::project_springs<width>(p, s, start, x);                                                                \
    }                                                                                                              \
    target static void volume(Triangles t, ConstField x, float* r) { body::volume<float, width>(t, x, r); }        \
    target static void medians(Triangles t, ConstField x, float* m) { body::medians<width>(t, x, m); }             \
    target static void stretch(Springs s, ConstField a, float* sum) { body::stretch<width>(s, a, sum); }           \
    target static void square_sum(std::size_t n, ConstField a, float* sum) { body::square_sum<width>(n, a, sum); } \
    target static void pressure(Triangles t, ConstField x, const float* p, Field<float> f) {                       \
      body::pressure<float, width>(t, x, p, f);                                                                    \
    }                                                                                                              \
    target static void shape_moments(Shape s, ConstField x, ShapeMoments<float>& m) {                              \
      body::shape_moments<float, width>(s, x, m);                                                                  \
    }                                                                                                              \
    target static void shape_pull(Shape s, const ShapePose<float>& p, float k, ConstField x, Field<float> f) {     \
      body::shape_pull<float, width>(s, p, k, x, f);                                                               \
    }                                                                                                              \
    target static void kick(const KickArguments& k, ConstField f, Field<float> v) { body::kick<width>(k, f, v); }  \
    target static unsigned solid(const SolidArguments& s, ConstField x, Field<float> v) {                          \
      return body::solid<width>(s, x, v);                                                                          \
    }                                                                                                              \
    target static void drift(std::size_t n, float h, const float* moves, ConstField v, Field<float> x) {           \
      body::drift<width>(n, h, moves, v, x);                                                                       \
    }                                                                                                              \
    target static void extent(std::size_t n, ConstField x, ConstField v, Extent& e) {                              \
      body::extent<width>(n, x, v, e);                                                                             \
    }                                                                                                              \
    target static void rigid_sums(std::size_t n, ConstField x, ConstField v, RigidSums& s) {                       \
      body::rigid_sums<width>(n, x, v, s);                                                                         \
    }                                                                                                              \
    target static void add_rigid(std::size_t n, const RigidChange& c, ConstField x, Field<float> v) {              \
      body::add_rigid<width>(n, c, x, v);                                                                          \
    }                                                                                                              \
    static constexpr Kernels table{springs,    project_springs, volume,        medians,    stretch,                \
                                   square_sum, pressure,        shape_moments, shape_pull, kick,                   \
                                   solid,      drift,           extent,        rigid_sums, add_rigid};             \
  };

SB_KERNEL_TABLE(Baseline, lanes, )
SB_KERNEL_TABLE(BaselineByItself, one_lane, )
#if SB_X86
SB_KERNEL_TABLE(Avx2, lanes, [[gnu::target("avx2")]])
SB_KERNEL_TABLE(Avx2ByItself, one_lane, [[gnu::target("avx2")]])
#endif

}  // namespace

const Kernels& kernels(Isa isa, int width) {
#if SB_X86
  if (isa == Isa::avx2) return width == one_lane ? Avx2ByItself::table : Avx2::table;
#endif
  (void)isa;
  return width == one_lane ? BaselineByItself::table : Baseline::table;
}

}  // namespace softbody
