#include "softbody/integrate/kernels.h"

#include "softbody/contact/solid_kernel.h"

namespace softbody {
namespace {

using ConstField = Field<const float>;

// One table an instruction set and width. The bodies are inlined into functions that carry the target attribute; a
// resolver of the linker (ifunc) would do the same but does not work under the sanitizers.
#define SB_KERNEL_TABLE(name, width, target)                                                                      \
  struct name {                                                                                                   \
    target static void kick(const KickArguments& k, ConstField f, Field<float> v) { body::kick<width>(k, f, v); } \
    target static unsigned solid(const SolidArguments& s, ConstField x, Field<float> v) {                         \
      return body::solid<width>(s, x, v);                                                                         \
    }                                                                                                             \
    target static void drift(std::size_t n, float h, const float* moves, ConstField v, Field<float> x) {          \
      body::drift<width>(n, h, moves, v, x);                                                                      \
    }                                                                                                             \
    target static void extent(std::size_t n, ConstField x, ConstField v, Extent& e) {                             \
      body::extent<width>(n, x, v, e);                                                                            \
    }                                                                                                             \
    target static void rigid_sums(std::size_t n, ConstField x, ConstField v, RigidSums& s) {                      \
      body::rigid_sums<width>(n, x, v, s);                                                                        \
    }                                                                                                             \
    target static void add_rigid(std::size_t n, const RigidChange& c, ConstField x, Field<float> v) {             \
      body::add_rigid<width>(n, c, x, v);                                                                         \
    }                                                                                                             \
    static constexpr Kernels table{kick, solid, drift, extent, rigid_sums, add_rigid};                            \
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
