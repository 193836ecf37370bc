#include "softbody/state/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "softbody/state/kernels.cpp"
#include <hwy/foreach_target.h>

#include "softbody/state/simd.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {
namespace {

using namespace simd;
using ConstField = Field<const float>;

template <int width>
void copy(std::size_t used, std::size_t particles, const float* moves, ConstField from, Field<float> to) {
  using V = Run<float, width>;
  for (std::size_t first = 0; first < used; first += lanes_of<V>) {
    const auto moving = load<V>(moves + first) > V{};
    for (std::size_t at = first; at < particles * width; at += width)
      store(to, at, select(moving, load<V>(from, at), load<V>(to, at)));
  }
}

template <int width>
void add(std::size_t used, std::size_t particles, const float* moves, float times, ConstField a, Field<float> to) {
  using V = Run<float, width>;
  for (std::size_t first = 0; first < used; first += lanes_of<V>) {
    const auto moving = load<V>(moves + first) > V{};
    for (std::size_t at = first; at < particles * width; at += width)
      store(to, at, load<V>(to, at) + select(moving, V(times) * load<V>(a, at), Vec<V>{}));
  }
}

template <int width>
void scale(std::size_t used, std::size_t particles, const float* moves, float times, Field<float> a) {
  using V = Run<float, width>;
  for (std::size_t first = 0; first < used; first += lanes_of<V>) {
    const V factor = select(load<V>(moves + first) > V{}, V(times), V(1));
    for (std::size_t at = first; at < particles * width; at += width) store(a, at, factor * load<V>(a, at));
  }
}

template <int width>
void kick(std::size_t used, const KickArguments& k, ConstField f, Field<float> v) {
  using V = Run<float, width>;
  for (std::size_t first = 0; first < used; first += lanes_of<V>) {
    const V moves = load<V>(k.moves + first), scale = k.h_over_mass * moves;
    const Vec<V> g{k.gx * moves, k.gy * moves, k.gz * moves};
    for (std::size_t at = first; at < k.particles * width; at += width)
      store(v, at, load<V>(v, at) + scale * load<V>(f, at) + g);
  }
}

template <int width>
void accelerate(std::size_t used, const KickArguments& k, Field<float> f) {
  using V = Run<float, width>;
  const Vec<V> g{k.gx, k.gy, k.gz};
  for (std::size_t first = 0; first < used; first += lanes_of<V>)
    for (std::size_t at = first; at < k.particles * width; at += width)
      store(f, at, V(k.h_over_mass) * load<V>(f, at) + g);
}

template <int width>
void extent(std::size_t used, std::size_t particles, ConstField boxed, ConstField measured, Extent& e) {
  using V = Run<float, width>;
  for (std::size_t first = 0; first < used; first += lanes_of<V>) {
    Vec<V> lo = load<V>(boxed, first), hi = lo;
    V length2{}, sum2{};
    for (std::size_t at = first; at < particles * width; at += width) {
      const Vec<V> p = load<V>(boxed, at), u = load<V>(measured, at);
      lo = {smaller(p.x, lo.x), smaller(p.y, lo.y), smaller(p.z, lo.z)};
      hi = {larger(p.x, hi.x), larger(p.y, hi.y), larger(p.z, hi.z)};
      length2 = larger(dot(u, u), length2);
      sum2 += dot(u, u);
    }
    store(field(e.lo), first, lo);
    store(field(e.hi), first, hi);
    store(e.length2 + first, length2);
    store(e.sum2 + first, sum2);
  }
}

/// Unpacks one component. It takes as many particles at a time as fill a line of the cache, by squares of four
/// particles and four lanes, of which rows become columns.
template <int width>
void unpack(std::size_t used, std::size_t particles, const float* a, const double* offset, const std::size_t* first,
            float* to) {
  using V = Run<double, width>;
  using F = Run<float, width, lanes_of<V>>;
  constexpr std::size_t most = 16, side = std::min({width, register_lanes<float>, 4});
  float block[most * width];
  for (std::size_t i = 0; i < particles; i += most) {
    const std::size_t rows = std::min(most, particles - i);
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t l = 0; l < used; l += lanes_of<V>)
        store(block + r * width + l, narrowed(widened(load<F>(a + (i + r) * width + l)) + load<V>(offset + l)));
    for (std::size_t l = 0; l < used; l += side) {
      const std::size_t columns = std::min(side, used - l);
      std::size_t r = 0;
      if constexpr (side == 4)
        for (; r + side <= rows; r += side) {
          Lane<float, 4> square[side];
          for (std::size_t k = 0; k < side; ++k) square[k] = load<Lane<float, 4>>(block + (r + k) * width + l);
          transpose(square);
          for (std::size_t c = 0; c < columns; ++c) store(to + first[l + c] + i + r, square[c]);
        }
      for (; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c) to[first[l + c] + i + r] = block[r * width + l + c];
    }
  }
}

template <int width>
void unpack(std::size_t used, std::size_t particles, ConstField a, const DoubleLaneVector& offset,
            const std::size_t* first, Field<float> to) {
  unpack<width>(used, particles, a.x, offset.x, first, to.x);
  unpack<width>(used, particles, a.y, offset.y, first, to.y);
  unpack<width>(used, particles, a.z, offset.z, first, to.z);
}

/// Computes with floats as many at a time as a register holds doubles.
template <int width>
void rigid_sums(std::size_t used, std::size_t particles, ConstField x, ConstField v, RigidSums& sums) {
  using V = Run<double, width>;
  using F = Run<float, width, lanes_of<V>>;
  for (std::size_t first = 0; first < used; first += lanes_of<V>) {
    const Vec<V> origin = widened(load<F>(x, first));
    Vec<V> place{}, velocity{}, momentum{}, square{}, mixed{};
    for (std::size_t at = first; at < particles * width; at += width) {
      const Vec<V> r = widened(load<F>(x, at)) - origin, u = widened(load<F>(v, at));
      place = place + r;
      velocity = velocity + u;
      momentum = momentum + cross(r, u);
      square = square + Vec<V>{r.x * r.x, r.y * r.y, r.z * r.z};
      mixed = mixed + Vec<V>{r.y * r.z, r.z * r.x, r.x * r.y};
    }
    store(field(sums.place), first, place);
    store(field(sums.velocity), first, velocity);
    store(field(sums.momentum), first, momentum);
    store(field(sums.square), first, square);
    store(field(sums.mixed), first, mixed);
  }
}

template <int width>
void change_rigidly(std::size_t used, std::size_t particles, const RigidChange& change, ConstField x, Field<float> v) {
  using V = Run<double, width>;
  using F = Run<float, width, lanes_of<V>>;
  for (std::size_t first = 0; first < used; first += lanes_of<V>) {
    const auto acts = load<F>(change.acts + first) > F{};
    const V keep = load<V>(change.keep + first);
    const Vec<V> push = load<V>(field(change.push), first), spin = load<V>(field(change.spin), first);
    const Vec<V> centre = widened(load<F>(x, first)) + load<V>(field(change.about), first);
    for (std::size_t at = first; at < particles * width; at += width) {
      const Vec<F> before = load<F>(v, at);
      const Vec<V> after = keep * widened(before) + push + cross(spin, widened(load<F>(x, at)) - centre);
      store(v, at, select(acts, narrowed(after), before));
    }
  }
}

template <int width>
constexpr StateKernels table{copy<width>,   add<width>,    scale<width>,      kick<width>,          accelerate<width>,
                             extent<width>, unpack<width>, rigid_sums<width>, change_rigidly<width>};

const StateKernels& Table(int width) {
  return with_width(width, [](auto w) -> const StateKernels& { return table<w>; });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody {

HWY_EXPORT(Table);

const StateKernels& state_kernels(int width) { return HWY_DYNAMIC_DISPATCH(Table)(width); }

}  // namespace softbody
#endif  // HWY_ONCE
