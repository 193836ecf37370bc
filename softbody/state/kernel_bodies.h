#pragma once
// Arithmetic of the state's kernels for `width` bodies at a time: eight, or one alone. Each file that includes this
// compiles it for one instruction set.

#include <cstring>
#include <type_traits>

#include "softbody/state/kernel_types.h"
#include "softbody/state/lane_math.h"

namespace softbody::body {

/// Loads one value for each lane.
template <class V, class Real>
SB_INLINE V load(const Real* p) {
  V v;
  if constexpr (std::is_same_v<V, DoubleLane>) {
    std::memcpy(&v.lo, p, sizeof v.lo);
    std::memcpy(&v.hi, p + lanes / 2, sizeof v.hi);
  } else {
    std::memcpy(&v, p, sizeof v);
  }
  return v;
}

template <class V, class Real>
SB_INLINE void store(Real* p, const V& v) {
  if constexpr (std::is_same_v<V, DoubleLane>) {
    std::memcpy(p, &v.lo, sizeof v.lo);
    std::memcpy(p + lanes / 2, &v.hi, sizeof v.hi);
  } else {
    std::memcpy(p, &v, sizeof v);
  }
}

template <class V, class Real>
SB_INLINE Vec<V> load(Field<Real> f, std::size_t at) {
  return {load<V>(f.x + at), load<V>(f.y + at), load<V>(f.z + at)};
}

template <class V, class Real>
SB_INLINE void store(Field<Real> f, std::size_t at, const Vec<V>& v) {
  store(f.x + at, v.x);
  store(f.y + at, v.y);
  store(f.z + at, v.z);
}

/// Part of the lanes, in doubles and in floats: so many that registers hold a dozen sums of them.
template <int width>
using DoublePart = std::conditional_t<width == one_lane, double, DoubleLane::Half>;
typedef float HalfLane __attribute__((vector_size(lanes / 2 * sizeof(float))));
template <int width>
using FloatPart = std::conditional_t<width == one_lane, float, HalfLane>;

SB_INLINE double widened(float v) { return double(v); }
SB_INLINE DoubleLane::Half widened(HalfLane v) { return __builtin_convertvector(v, DoubleLane::Half); }
SB_INLINE float narrowed(double v) { return float(v); }
SB_INLINE HalfLane narrowed(DoubleLane::Half v) { return __builtin_convertvector(v, HalfLane); }

template <class V>
SB_INLINE auto widened(const Vec<V>& v) {
  return Vec<decltype(widened(v.x))>{widened(v.x), widened(v.y), widened(v.z)};
}

template <class V>
SB_INLINE Vec<V> load(const LaneVector& v) {
  return {load<V>(v.x), load<V>(v.y), load<V>(v.z)};
}

SB_INLINE Field<double> field(DoubleLaneVector& v) { return {v.x, v.y, v.z}; }
SB_INLINE Field<const double> field(const DoubleLaneVector& v) { return {v.x, v.y, v.z}; }

/// Returns a bit for each lane in which a > b.
template <class V>
SB_INLINE unsigned lanes_above(V a, V b) {
  unsigned bits = 0;
  for (int l = 0; l < lanes; ++l) bits |= unsigned(a[l] > b[l]) << l;
  return bits;
}

SB_INLINE unsigned lanes_above(float a, float b) { return a > b; }

/// Sums the squared lengths of all particles' vectors.
template <int width>
SB_INLINE void square_sum(std::size_t particles, Field<const float> a, float* sum) {
  using V = Lane<float, width>;
  V all{};
  for (std::size_t i = 0; i < particles; ++i) {
    const Vec<V> v = load<V>(a, i * width);
    all += dot(v, v);
  }
  store(sum, all);
}

template <int width>
SB_INLINE void kick(const KickArguments& k, Field<const float> f, Field<float> v) {
  using V = Lane<float, width>;
  const V moves = load<V>(k.moves);
  const V scale = k.h_over_mass * moves;
  const Vec<V> g{k.gx * moves, k.gy * moves, k.gz * moves};
  for (std::size_t at = 0; at < k.particles * width; at += width)
    store(v, at, load<V>(v, at) + scale * load<V>(f, at) + g);
}

template <int width>
SB_INLINE void drift(std::size_t particles, float h, const float* moves, Field<const float> v, Field<float> x) {
  using V = Lane<float, width>;
  const V step = h * load<V>(moves);
  for (std::size_t at = 0; at < particles * width; at += width) store(x, at, load<V>(x, at) + step * load<V>(v, at));
}

template <int width>
SB_INLINE void extent(std::size_t particles, Field<const float> boxed, Field<const float> measured, Extent& e) {
  using V = Lane<float, width>;
  Vec<V> lo = load<V>(boxed, 0), hi = lo;
  V length2{};
  for (std::size_t at = 0; at < particles * width; at += width) {
    const Vec<V> p = load<V>(boxed, at), u = load<V>(measured, at);
    lo = {smaller(p.x, lo.x), smaller(p.y, lo.y), smaller(p.z, lo.z)};
    hi = {larger(p.x, hi.x), larger(p.y, hi.y), larger(p.z, hi.z)};
    length2 = larger(dot(u, u), length2);
  }
  store(Field<float>{e.lo.x, e.lo.y, e.lo.z}, 0, lo);
  store(Field<float>{e.hi.x, e.hi.y, e.hi.z}, 0, hi);
  store(e.length2, length2);
}

template <int width>
SB_INLINE void rigid_sums(std::size_t particles, Field<const float> x, Field<const float> v, RigidSums& sums) {
  using V = DoublePart<width>;
  using F = FloatPart<width>;
  for (std::size_t lane = 0; lane < width; lane += sizeof(V) / sizeof(double)) {
    const Vec<V> first = widened(load<F>(x, lane));
    Vec<V> place{}, velocity{}, momentum{}, square{}, mixed{};
    for (std::size_t at = lane; at < particles * width; at += width) {
      const Vec<V> r = widened(load<F>(x, at)) - first, u = widened(load<F>(v, at));
      place = place + r;
      velocity = velocity + u;
      momentum = momentum + cross(r, u);
      square = square + Vec<V>{r.x * r.x, r.y * r.y, r.z * r.z};
      mixed = mixed + Vec<V>{r.y * r.z, r.z * r.x, r.x * r.y};
    }
    store(field(sums.place), lane, place);
    store(field(sums.velocity), lane, velocity);
    store(field(sums.momentum), lane, momentum);
    store(field(sums.square), lane, square);
    store(field(sums.mixed), lane, mixed);
  }
}

template <int width>
SB_INLINE void add_rigid(std::size_t particles, const RigidChange& change, Field<const float> x, Field<float> v) {
  using V = DoublePart<width>;
  using F = FloatPart<width>;
  for (std::size_t lane = 0; lane < width; lane += sizeof(V) / sizeof(double)) {
    const F acts = load<F>(change.acts + lane), zero{};
    const auto either = [&](F before, V after) { return acts > zero ? narrowed(after) : before; };
    const Vec<V> push = load<V>(field(change.push), lane), spin = load<V>(field(change.spin), lane);
    const Vec<V> centre = widened(load<F>(x, lane)) + load<V>(field(change.about), lane);
    for (std::size_t at = lane; at < particles * width; at += width) {
      const Vec<F> before = load<F>(v, at);
      const Vec<V> after = widened(before) + push + cross(spin, widened(load<F>(x, at)) - centre);
      store(v, at, Vec<F>{either(before.x, after.x), either(before.y, after.y), either(before.z, after.z)});
    }
  }
}

}  // namespace softbody::body
