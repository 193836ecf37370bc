#include "softbody/forces/kernels.h"

#include "softbody/forces/kernel_bodies.h"

namespace softbody {
namespace {

/// Table: has the functions add<F>, project<F> and measure_surfaces, compiled for one instruction set.
template <class Table>
constexpr ForceKernels make_table() {
  ForceKernels kernels{};
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (HasElements<F>) kernels.add[index_of<F>] = &Table::template add<F>;
    if constexpr (is_projected<F>()) kernels.project[index_of<F>] = &Table::template project<F>;
  });
  kernels.measure_surfaces = &Table::measure_surfaces;
  return kernels;
}

// One table an instruction set and width. The bodies are inlined into functions that carry the target attribute; a
// resolver of the linker (ifunc) would do the same but does not work under the sanitizers.
#define SB_FORCE_TABLE(name, width, target)                                                                  \
  struct name {                                                                                              \
    template <class F>                                                                                       \
    target static void add(const LaneBodies<float>& b, const Moving& motion) {                               \
      body::add_force<F, width>(b, motion);                                                                  \
    }                                                                                                        \
    template <class F>                                                                                       \
    target static void project(const LaneBodies<float>& b, const Projection& p) {                            \
      body::project<F, width>(b, p);                                                                         \
    }                                                                                                        \
    target static void measure_surfaces(const LaneBodies<float>& b, SurfaceShape* shapes) {                  \
      body::measure_surfaces<width>(b, shapes);                                                              \
    }                                                                                                        \
    target static void hold(const LaneBodies<double>& b, HeldForces& held) { body::hold_forces(b, held); }   \
    target static void add_all(const LaneBodies<double>& b, const HeldForces& h, const SinceStart& s) {      \
      body::add_forces<false>(b, h, s);                                                                      \
    }                                                                                                        \
    target static void add_external(const LaneBodies<double>& b, const HeldForces& h, const SinceStart& s) { \
      body::add_forces<true>(b, h, s);                                                                       \
    }                                                                                                        \
  };

SB_FORCE_TABLE(Baseline, lanes, )
SB_FORCE_TABLE(BaselineByItself, one_lane, )
#if SB_X86
SB_FORCE_TABLE(Avx2, lanes, [[gnu::target("avx2")]])
SB_FORCE_TABLE(Avx2ByItself, one_lane, [[gnu::target("avx2")]])
#endif

template <class Table>
constexpr ForceKernels table = make_table<Table>();
template <class Table>
constexpr ImplicitForceKernels implicit_table{&Table::hold, &Table::add_all, &Table::add_external};

}  // namespace

const ForceKernels& force_kernels(Isa isa, int width) {
#if SB_X86
  if (isa == Isa::avx2) return width == one_lane ? table<Avx2ByItself> : table<Avx2>;
#endif
  (void)isa;
  return width == one_lane ? table<BaselineByItself> : table<Baseline>;
}

const ImplicitForceKernels& implicit_force_kernels(Isa isa) {
#if SB_X86
  if (isa == Isa::avx2) return implicit_table<Avx2>;
#endif
  (void)isa;
  return implicit_table<Baseline>;
}

}  // namespace softbody
