#include "softbody/mechanics/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "softbody/mechanics/kernels.cpp"
#include <hwy/foreach_target.h>

#include "softbody/mechanics/kernel_bodies.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {
namespace {

using namespace simd;

/// The kernels of one width: each run of lanes on its own.
template <int width>
struct Kernels {
  using V = Run<float, width>;
  static constexpr std::size_t step = lanes_of<V>;

  template <class F>
  static void add(const LaneBodies<float>& all, const Moving& motion) {
    const auto* d = data<F>(all.model);
    if (!d) return;
    for (std::size_t l = 0; l < std::size_t(all.used); l += step) {
      const LaneBodies<float> b = all.from(l);
      HeldOf<F, float> held{};
      hold<F, V, width>(*d, b.x, b.used, held);
      const Moving moving{motion.v + l};
      visit<F, V>(b.model, *d, held, AddForces<V, width, Moving>{b, moving});
    }
  }
  template <class F>
  static void project(const LaneBodies<float>& all, const Projection& p) {
    const auto* d = data<F>(all.model);
    if (!d) return;
    for (std::size_t l = 0; l < std::size_t(all.used); l += step) {
      const LaneBodies<float> b = all.from(l);
      const Projection own = p.from(l);
      const auto inverse_mass = float(1 / b.model.particle_mass);
      if (own.free)
        visit<F, V>(b.model, *d, {}, Project<V, width, true>{b, own, inverse_mass});
      else
        visit<F, V>(b.model, *d, {}, Project<V, width, false>{b, own, inverse_mass});
    }
  }
  /// Calls at(bodies, arguments, velocities, lane) for each run of lanes.
  template <class At>
  static void for_each_run(const LaneBodies<float>& all, const KickArguments& k, Field<float> v, const At& at) {
    for (std::size_t l = 0; l < std::size_t(all.used); l += step) {
      KickArguments own = k;
      own.moves += l;
      at(all.from(l), own, v + l, l);
    }
  }
  static void advance(const LaneBodies<float>& all, const KickArguments& k, const Advance& how, Field<float> v,
                      LaneVolumes& volumes) {
    const bool presses = all.model.forces->pressure > 0;
    for_each_run(all, k, v, [&](const auto& b, const auto& own, Field<float> u, std::size_t lane) HWY_ATTR {
      kick<V, width>(b, own, u, volumes, lane);
      if (presses) press<V, width>(b, own, how.volumes == Volumes::implicit_, u, volumes, lane);
      if (how.drift.x) drift<V, width>(b, own, u, how.drift + lane);
    });
  }
  static void press_again(const LaneBodies<float>& all, const KickArguments& k, Field<float> v, LaneVolumes& volumes) {
    for_each_run(all, k, v, [&](const auto& b, const auto& own, Field<float> u, std::size_t lane) HWY_ATTR {
      V rate{};
      for (std::size_t at = 0; at < b.model.mesh.vertices.size() * width; at += width)
        rate += dot(load<V>(b.f, at), load<V>(u, at));
      store(volumes.rate + lane, rate);
      press<V, width>(b, own, true, u, volumes, lane);
    });
  }
  static void measure_surfaces(const LaneBodies<float>& all, SurfaceShape* result) {
    const std::vector<Triangle>& faces = all.model.mesh.triangles;
    for (std::size_t first = 0; first < std::size_t(all.used); first += step) {
      const LaneBodies<float> b = all.from(first);
      float volumes[lanes]{}, area2[lanes]{}, stretch[lanes]{}, two_medians[lanes]{};
      medians<V, width>(faces, b.x, two_medians);
      const Vec<V> from = load<V>(b.x, 0);
      V three_volumes{}, square{}, sum{};
      for (Index i = 0; i < b.model.mesh.vertices.size(); ++i) {
        const std::size_t at = i * width;
        const Vec<V> x = load<V>(b.x, at), a = area_of<V, width>(b, i, x);
        store(b.f, at, a);
        three_volumes += dot(a, x - from);
        square += dot(a, a);
      }
      store(volumes, three_volumes / V(3.0f));
      store(area2, square);
      for_each_force(Forces{}, [&]<class F>(Name<F>) HWY_ATTR {
        if constexpr (coordinate_of<F>() == Coordinate::length)
          if (const auto* d = data<F>(b.model)) visit<F, V>(b.model, *d, {}, AddStretch<V, width>{b.f, sum});
      });
      store(stretch, sum);
      for (int l = 0; l < std::min(b.used, int(step)); ++l)
        result[first + std::size_t(l)] = {volumes[l], area2[l], stretch[l], two_medians[l]};
    }
  }
  static void measure_motion(const MovingBodies& all, MotionSums& sums) {
    using D = Run<double, width>;
    for (std::size_t l = 0; l < std::size_t(all.used); l += lanes_of<D>) {
      const MovingBodies b = all.from(l);
      Vec<D> place{}, velocity{};
      D square{}, fastest2{};
      for (std::size_t at = 0; at < b.model.mesh.vertices.size() * width; at += width) {
        const Vec<D> u = load<D>(b.v, at);
        place = place + load<D>(b.x, at);
        velocity = velocity + u;
        square += dot(u, u);
        fastest2 = larger(dot(u, u), fastest2);
      }
      store(field(sums.place), l, place);
      store(field(sums.velocity), l, velocity);
      store(sums.square + l, square);
      store(sums.fastest2 + l, fastest2);
      StoredSums<D> stored{};
      if (b.model.mesh.closed) volume_and_rate<D, width>(b, stored);
      for_each_force(Forces{}, [&]<class F>(Name<F>) HWY_ATTR {
        if constexpr (HasElements<F>)
          if (const auto* d = data<F>(b.model)) {
            HeldOf<F, double> held{};
            hold<F, D, width>(*d, b.x, b.used, held);
            visit<F, D>(b.model, *d, held, AddStored<D, width>{b, stored});
          }
      });
      for (int k = 0; k < std::min(b.used, lanes_of<D>); ++k) {
        sums.volume[l + std::size_t(k)] = stored.volume[k];
        sums.gas[l + std::size_t(k)] = stored.gas[k];
      }
      store(sums.elastic + l, stored.elastic);
      store(sums.growth + l, stored.growth + load<D>(stored.gas_growth));
      store(sums.strain + l, stored.strain);
    }
  }
  static constexpr ForceKernels make() {
    ForceKernels kernels{};
    for_each_force(Forces{}, [&]<class F>(Name<F>) {
      if constexpr (HasElements<F>) kernels.add[index_of<F>] = &Kernels::template add<F>;
      if constexpr (is_projected<F>()) kernels.project[index_of<F>] = &Kernels::template project<F>;
    });
    kernels.advance = &Kernels::advance;
    kernels.press_again = &Kernels::press_again;
    kernels.measure_surfaces = &Kernels::measure_surfaces;
    kernels.measure_motion = &Kernels::measure_motion;
    return kernels;
  }
};
template <int width>
constexpr ForceKernels table = Kernels<width>::make();

using W = Wide<double, implicit_lanes>;

void hold_forces(const LaneBodies<double>& b, HeldForces& held) {
  for_each_force(Forces{}, [&]<class F>(Name<F>) HWY_ATTR {
    if constexpr (HasElements<F>)
      if (const auto* d = data<F>(b.model)) hold<F, W, implicit_lanes>(*d, b.x, b.used, std::get<index_of<F>>(held));
  });
}

template <bool external_only>
void add_forces(const LaneBodies<double>& b, const HeldForces& held, const SinceStart& motion) {
  for_each_force(Forces{}, [&]<class F>(Name<F>) HWY_ATTR {
    if constexpr (HasElements<F>) {
      if constexpr (!external_only || !F::internal)
        if (const auto* d = data<F>(b.model))
          visit<F, W>(b.model, *d, std::get<index_of<F>>(held), AddForces<W, implicit_lanes, SinceStart>{b, motion});
    }
  });
}

constexpr ImplicitForceKernels implicit_table{hold_forces, add_forces<false>, add_forces<true>};

const ForceKernels& Table(int width) {
  return with_width(width, [](auto w) -> const ForceKernels& { return table<w>; });
}
const ImplicitForceKernels& ImplicitTable() { return implicit_table; }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody {

HWY_EXPORT(Table);
HWY_EXPORT(ImplicitTable);

const ForceKernels& force_kernels(int width) { return HWY_DYNAMIC_DISPATCH(Table)(width); }
const ImplicitForceKernels& implicit_force_kernels() { return HWY_DYNAMIC_DISPATCH(ImplicitTable)(); }

}  // namespace softbody
#endif  // HWY_ONCE
