#include "softbody/integrate/implicit/kernels.h"

#include "softbody/integrate/implicit/kernel_bodies.h"

namespace softbody {
namespace {

using Field64 = Field<double>;

// One table an instruction set, as in integrate/kernels.cpp.
#define SB_IMPLICIT_TABLE(name, isa, target)                                                                        \
  struct name {                                                                                                     \
    target static void substitute(const CholeskyFactor& c, double* x, double* z) { body::substitute(c, x, z); }     \
    target static void turn(std::size_t n, const double (*r)[lanes], bool back, Field64 v) {                        \
      body::turn(n, r, back, v);                                                                                    \
    }                                                                                                               \
    target static void inner_product(std::size_t n, const double* a, const double* b, double* r) {                  \
      body::inner_product(n, a, b, r);                                                                              \
    }                                                                                                               \
    target static void inner_product_shared(std::size_t n, const double* a, const double* b, double* r) {           \
      body::inner_product_shared(n, a, b, r);                                                                       \
    }                                                                                                               \
    target static void add_scaled(std::size_t n, const double* t, const double* a, double* y) {                     \
      body::add_scaled(n, t, a, y);                                                                                 \
    }                                                                                                               \
    target static void add_scaled_shared(std::size_t n, const double* t, const double* a, double* y) {              \
      body::add_scaled_shared(n, t, a, y);                                                                          \
    }                                                                                                               \
    static constexpr ImplicitKernels table{isa,        substitute,       turn, inner_product, inner_product_shared, \
                                           add_scaled, add_scaled_shared};                                          \
  };

SB_IMPLICIT_TABLE(BaselineImplicit, Isa::baseline, )
#if SB_X86
SB_IMPLICIT_TABLE(Avx2Implicit, Isa::avx2, [[gnu::target("avx2")]])
#endif

}  // namespace

const ImplicitKernels& implicit_kernels(Isa isa) {
#if SB_X86
  if (isa == Isa::avx2) return Avx2Implicit::table;
#endif
  (void)isa;
  return BaselineImplicit::table;
}

}  // namespace softbody
