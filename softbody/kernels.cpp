#include "softbody/kernels.h"

#include "softbody/implicit_kernels.h"

#if defined(__x86_64__) || defined(__i386__)
#define SB_X86 1
#else
#define SB_X86 0
#endif

namespace softbody {
namespace {

using ConstField = Field<const float>;
using Field64 = Field<double>;
using ConstField64 = Field<const double>;
using Springs64 = std::span<const KernelSpring<double>>;
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

#define SB_IMPLICIT_TABLE(name, target)                                                                         \
  struct name {                                                                                                 \
    target static void springs(Springs64 s, double inverse_h, ConstField64 x, ConstField64 from, Field64 f) {   \
      body::implicit_springs(s, inverse_h, x, from, f);                                                         \
    }                                                                                                           \
    target static void volume(Triangles t, ConstField64 x, double* r) { body::volume<double, lanes>(t, x, r); } \
    target static void pressure(Triangles t, ConstField64 x, const double* p, Field64 f) {                      \
      body::pressure<double, lanes>(t, x, p, f);                                                                \
    }                                                                                                           \
    target static void substitute(const CholeskyFactor& c, double* x, double* z) { body::substitute(c, x, z); } \
    target static void turn(std::size_t n, const double (*r)[lanes], bool back, Field64 v) {                    \
      body::turn(n, r, back, v);                                                                                \
    }                                                                                                           \
    target static void inner_product(std::size_t n, const double* a, const double* b, double* r) {              \
      body::inner_product(n, a, b, r);                                                                          \
    }                                                                                                           \
    target static void inner_product_shared(std::size_t n, const double* a, const double* b, double* r) {       \
      body::inner_product_shared(n, a, b, r);                                                                   \
    }                                                                                                           \
    target static void add_scaled(std::size_t n, const double* t, const double* a, double* y) {                 \
      body::add_scaled(n, t, a, y);                                                                             \
    }                                                                                                           \
    target static void add_scaled_shared(std::size_t n, const double* t, const double* a, double* y) {          \
      body::add_scaled_shared(n, t, a, y);                                                                      \
    }                                                                                                           \
    static constexpr ImplicitKernels table{                                                                     \
        springs,    volume,           pressure, substitute, turn, inner_product, inner_product_shared,          \
        add_scaled, add_scaled_shared};                                                                         \
  };

SB_KERNEL_TABLE(Baseline, lanes, )
SB_KERNEL_TABLE(BaselineByItself, one_lane, )
SB_IMPLICIT_TABLE(BaselineImplicit, )
#if SB_X86
SB_KERNEL_TABLE(Avx2, lanes, [[gnu::target("avx2")]])
SB_KERNEL_TABLE(Avx2ByItself, one_lane, [[gnu::target("avx2")]])
SB_IMPLICIT_TABLE(Avx2Implicit, [[gnu::target("avx2")]])
#endif

}  // namespace

Isa best_isa() {
#if SB_X86
  return __builtin_cpu_supports("avx2") ? Isa::avx2 : Isa::baseline;
#else
  return Isa::baseline;
#endif
}

const Kernels& kernels(Isa isa, int width) {
#if SB_X86
  if (isa == Isa::avx2) return width == one_lane ? Avx2ByItself::table : Avx2::table;
#endif
  (void)isa;
  return width == one_lane ? BaselineByItself::table : Baseline::table;
}

const ImplicitKernels& implicit_kernels(Isa isa) {
#if SB_X86
  if (isa == Isa::avx2) return Avx2Implicit::table;
#endif
  (void)isa;
  return BaselineImplicit::table;
}

}  // namespace softbody
