// Highway's registers as numbers, so that arithmetic which is written once computes with a register of bodies or with
// one number. It is compiled once for each of Highway's targets: a file of kernels includes it, and what uses it, after
// <hwy/foreach_target.h> only. All other files see it for the target that they are compiled for. This include guard is
// Highway's.
#if defined(SOFTBODY_STATE_SIMD_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOFTBODY_STATE_SIMD_H
#undef SOFTBODY_STATE_SIMD_H
#else
#define SOFTBODY_STATE_SIMD_H
#endif

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <type_traits>

#include <hwy/highway.h>

#include "softbody/state/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {
namespace simd {

namespace hn = hwy::HWY_NAMESPACE;

/// Number of values that a register holds; those of a block at most.
template <class T>
constexpr int register_lanes = std::min(lanes, static_cast<int>(hn::MaxLanes(hn::ScalableTag<T>())));

/// n values side by side in one register. Functions that take or return such values stand in this namespace, since
/// those outside it are compiled for no target and pass registers in another way. Friends need HWY_ATTR: g++ does not
/// compile them for the target of the namespace. Operators are forced inline, so that a compiler that optimises refuses
/// a caller that is compiled for another target.
template <class T, int n>
struct Lane {
  using Tag = hn::CappedTag<T, n>;
  struct Mask {
    hn::Mask<Tag> raw;
  };
  hn::Vec<Tag> raw;

  Lane() = default;
  HWY_INLINE Lane(T all) : raw(hn::Set(Tag(), all)) {}
  HWY_INLINE explicit Lane(hn::Vec<Tag> values) : raw(values) {}

  HWY_INLINE HWY_ATTR friend Lane operator+(Lane a, Lane b) { return Lane(hn::Add(a.raw, b.raw)); }
  HWY_INLINE HWY_ATTR friend Lane operator-(Lane a, Lane b) { return Lane(hn::Sub(a.raw, b.raw)); }
  HWY_INLINE HWY_ATTR friend Lane operator*(Lane a, Lane b) { return Lane(hn::Mul(a.raw, b.raw)); }
  HWY_INLINE HWY_ATTR friend Lane operator/(Lane a, Lane b) { return Lane(hn::Div(a.raw, b.raw)); }
  HWY_INLINE Lane operator-() const { return Lane(hn::Neg(raw)); }
  HWY_INLINE Lane& operator+=(Lane b) { return *this = *this + b; }
  HWY_INLINE Lane& operator-=(Lane b) { return *this = *this - b; }
  HWY_INLINE HWY_ATTR friend Mask operator>(Lane a, Lane b) { return {hn::Gt(a.raw, b.raw)}; }
  HWY_INLINE HWY_ATTR friend Mask operator<(Lane a, Lane b) { return {hn::Lt(a.raw, b.raw)}; }
  HWY_INLINE HWY_ATTR friend Mask operator>=(Lane a, Lane b) { return {hn::Ge(a.raw, b.raw)}; }
};

/// What does not fit into one register, in two halves. Compilers keep wider vectors in memory, which is several times
/// slower.
template <class V>
struct Pair {
  V lo, hi;

  Pair() = default;
  template <class T>
  requires std::is_arithmetic_v<T> HWY_INLINE Pair(T all) : lo(all), hi(all) {}
  HWY_INLINE Pair(V low, V high) : lo(low), hi(high) {}

  HWY_INLINE HWY_ATTR friend Pair operator+(const Pair& a, const Pair& b) { return {a.lo + b.lo, a.hi + b.hi}; }
  HWY_INLINE HWY_ATTR friend Pair operator-(const Pair& a, const Pair& b) { return {a.lo - b.lo, a.hi - b.hi}; }
  HWY_INLINE HWY_ATTR friend Pair operator*(const Pair& a, const Pair& b) { return {a.lo * b.lo, a.hi * b.hi}; }
  HWY_INLINE HWY_ATTR friend Pair operator/(const Pair& a, const Pair& b) { return {a.lo / b.lo, a.hi / b.hi}; }
  HWY_INLINE Pair& operator+=(const Pair& b) { return *this = *this + b; }
  HWY_INLINE Pair& operator-=(const Pair& b) { return *this = *this - b; }
};

template <class T, int n>
struct WideOf {
  using Values = Lane<T, n>;
};
template <class T, int n>
requires(n > register_lanes<T>) struct WideOf<T, n> {
  using Values = Pair<typename WideOf<T, n / 2>::Values>;
};
/// n values side by side, in as many registers as they take.
template <class T, int n>
using Wide = typename WideOf<T, n>::Values;

/// What a kernel computes with at a time, in a block of so many lanes: as many as a register holds, or one value of a
/// body that is alone.
template <class T, int width, int n = register_lanes<T>>
using Run = std::conditional_t<width == one_lane, T, Lane<T, std::min(n, width)>>;

template <class V>
struct Values {
  using Type = V;
  static constexpr int count = 1;
};
template <class T, int n>
struct Values<Lane<T, n>> {
  using Type = T;
  static constexpr int count = n;
};
template <class V>
struct Values<Pair<V>> {
  using Type = typename Values<V>::Type;
  static constexpr int count = 2 * Values<V>::count;
};
/// The type of one value of V.
template <class V>
using Value = typename Values<V>::Type;
/// Number of values of V.
template <class V>
constexpr int lanes_of = Values<V>::count;

/// Loads values that follow each other, one for each lane.
template <class V>
HWY_INLINE V load(const auto* p) {
  if constexpr (std::is_floating_point_v<V>) {
    return *p;
  } else if constexpr (requires { V::lo; }) {
    return {load<decltype(V::lo)>(p), load<decltype(V::hi)>(p + lanes_of<V> / 2)};
  } else {
    return V(hn::LoadU(typename V::Tag(), p));
  }
}

template <class V>
HWY_INLINE void store(auto* p, const V& v) {
  if constexpr (std::is_floating_point_v<V>) {
    *p = v;
  } else if constexpr (requires { V::lo; }) {
    store(p, v.lo);
    store(p + lanes_of<V> / 2, v.hi);
  } else {
    hn::StoreU(v.raw, typename V::Tag(), p);
  }
}

template <class T, int n>
HWY_INLINE Lane<T, n> square_root(Lane<T, n> v) {
  return Lane<T, n>(hn::Sqrt(v.raw));
}
template <class V>
HWY_INLINE Pair<V> square_root(const Pair<V>& v) {
  return {square_root(v.lo), square_root(v.hi)};
}

/// Returns a where the mask holds, else b.
template <class T, int n>
HWY_INLINE Lane<T, n> select(typename Lane<T, n>::Mask mask, Lane<T, n> a, Lane<T, n> b) {
  return Lane<T, n>(hn::IfThenElse(mask.raw, a.raw, b.raw));
}

constexpr bool x86_registers = HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128;

// a > b ? a : b, and a < b ? a : b, also where one is not a number, or both are zero: x86's own instructions do that.
template <class T, int n>
HWY_INLINE Lane<T, n> larger(Lane<T, n> a, Lane<T, n> b) {
  if constexpr (x86_registers) return Lane<T, n>(hn::Max(a.raw, b.raw));
  return select(a > b, a, b);
}
template <class T, int n>
HWY_INLINE Lane<T, n> smaller(Lane<T, n> a, Lane<T, n> b) {
  if constexpr (x86_registers) return Lane<T, n>(hn::Min(a.raw, b.raw));
  return select(a < b, a, b);
}
template <class V>
HWY_INLINE Pair<V> larger(const Pair<V>& a, const Pair<V>& b) {
  return {larger(a.lo, b.lo), larger(a.hi, b.hi)};
}

/// Returns a bit for each lane in which a > b.
template <class T, int n>
HWY_INLINE unsigned lanes_above(Lane<T, n> a, Lane<T, n> b) {
  std::uint64_t bits = 0;
  hn::StoreMaskBits(typename Lane<T, n>::Tag(), (a > b).raw, reinterpret_cast<std::uint8_t*>(&bits));
  return static_cast<unsigned>(bits);
}

/// True if a > b in any lane.
template <class T, int n>
HWY_INLINE bool any_above(Lane<T, n> a, Lane<T, n> b) {
  return !hn::AllFalse(typename Lane<T, n>::Tag(), (a > b).raw);
}

/// Returns the values of the lanes whose bit is set, and 0 for others.
template <class T, int n>
HWY_INLINE Lane<T, n> select_bits(std::uint64_t bits, Lane<T, n> values) {
  const typename Lane<T, n>::Tag tag;
  return Lane<T, n>(
      hn::IfThenElseZero(hn::LoadMaskBits(tag, reinterpret_cast<const std::uint8_t*>(&bits)), values.raw));
}

/// Four values a lane, in a register each.
template <class V>
struct Quad {
  V x, y, z, w;
};

#if HWY_TARGET == HWY_SCALAR
template <class V>
HWY_INLINE Quad<V> gather_quads(const float* table, std::size_t stride, const std::uint32_t* index) {
  const float* row = table + stride * index[0];
  return {load<V>(row), load<V>(row + 1), load<V>(row + 2), load<V>(row + 3)};
}
#else
/// Loads the first four floats of every fourth row, side by side.
template <class D>
HWY_INLINE hn::Vec<D> gather_blocks(D tag, const float* table, std::size_t stride, const std::uint32_t* index) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    return hn::LoadU(tag, table + stride * index[0]);
  } else {
    const hn::Half<D> half;
    return hn::Combine(tag, gather_blocks(half, table, stride, index + hn::MaxLanes(half)),
                       gather_blocks(half, table, stride, index));
  }
}

/// Loads the first four floats of each lane's row of a table. index: the lanes' rows, which begin `stride` floats after
/// each other.
template <class V>
HWY_INLINE Quad<V> gather_quads(const float* table, std::size_t stride, const std::uint32_t* index) {
  const typename V::Tag tag;
  const hn::Repartition<std::uint64_t, typename V::Tag> twos;
  const auto rows = [=](int i) HWY_ATTR { return gather_blocks(tag, table, stride, index + i); };
  const auto xy01 = hn::BitCast(twos, hn::InterleaveLower(tag, rows(0), rows(1))),
             xy23 = hn::BitCast(twos, hn::InterleaveLower(tag, rows(2), rows(3))),
             zw01 = hn::BitCast(twos, hn::InterleaveUpper(tag, rows(0), rows(1))),
             zw23 = hn::BitCast(twos, hn::InterleaveUpper(tag, rows(2), rows(3)));
  return {V(hn::BitCast(tag, hn::InterleaveLower(twos, xy01, xy23))),
          V(hn::BitCast(tag, hn::InterleaveUpper(twos, xy01, xy23))),
          V(hn::BitCast(tag, hn::InterleaveLower(twos, zw01, zw23))),
          V(hn::BitCast(tag, hn::InterleaveUpper(twos, zw01, zw23)))};
}
#endif

/// Stores four values for each lane, one lane after another.
template <class V>
HWY_INLINE void store_quads(float* p, const Quad<V>& q) {
  hn::StoreInterleaved4(q.x.raw, q.y.raw, q.z.raw, q.w.raw, typename V::Tag(), p);
}

template <int n>
HWY_INLINE Lane<double, n> widened(Lane<float, n> v) {
  return Lane<double, n>(hn::PromoteTo(typename Lane<double, n>::Tag(), v.raw));
}
/// v: finite, or what comes of it depends on the target.
template <int n>
HWY_INLINE Lane<float, n> narrowed(Lane<double, n> v) {
  return Lane<float, n>(hn::DemoteTo(typename Lane<float, n>::Tag(), v.raw));
}

#if HWY_TARGET != HWY_SCALAR
/// Turns four rows into columns.
HWY_INLINE void transpose(Lane<float, 4> (&rows)[4]) {
  const Lane<float, 4>::Tag tag;
  const auto upper_lo = hn::InterleaveLower(tag, rows[0].raw, rows[1].raw),
             upper_hi = hn::InterleaveUpper(tag, rows[0].raw, rows[1].raw);
  const auto lo = hn::InterleaveLower(tag, rows[2].raw, rows[3].raw),
             hi = hn::InterleaveUpper(tag, rows[2].raw, rows[3].raw);
  rows[0].raw = hn::ConcatLowerLower(tag, lo, upper_lo);
  rows[1].raw = hn::ConcatUpperUpper(tag, lo, upper_lo);
  rows[2].raw = hn::ConcatLowerLower(tag, hi, upper_hi);
  rows[3].raw = hn::ConcatUpperUpper(tag, hi, upper_hi);
}
#endif

// Arithmetic that is written once: V is one value for each lane, or a float or double. So numbers have what lanes have.

HWY_INLINE auto square_root(std::floating_point auto v) { return std::sqrt(v); }
HWY_INLINE auto select(bool condition, std::floating_point auto a, std::same_as<decltype(a)> auto b) {
  return condition ? a : b;
}
HWY_INLINE auto larger(std::floating_point auto a, std::same_as<decltype(a)> auto b) { return a > b ? a : b; }
HWY_INLINE auto smaller(std::floating_point auto a, std::same_as<decltype(a)> auto b) { return a < b ? a : b; }
HWY_INLINE bool any_above(std::floating_point auto a, std::same_as<decltype(a)> auto b) { return a > b; }
HWY_INLINE unsigned lanes_above(std::floating_point auto a, std::same_as<decltype(a)> auto b) { return a > b; }
HWY_INLINE auto select_bits(std::uint64_t bits, std::floating_point auto value) { return bits & 1 ? value : 0; }
HWY_INLINE double widened(float v) { return double(v); }
HWY_INLINE float narrowed(double v) { return float(v); }

/// Three components for all lanes.
template <class V>
struct Vec {
  V x, y, z;
  HWY_INLINE HWY_ATTR friend Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  HWY_INLINE HWY_ATTR friend Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  HWY_INLINE HWY_ATTR friend Vec operator*(V s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
};

template <class V>
HWY_INLINE V dot(Vec<V> a, Vec<V> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class V>
HWY_INLINE Vec<V> cross(Vec<V> a, Vec<V> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Mask, class V>
HWY_INLINE Vec<V> select(Mask mask, Vec<V> a, Vec<V> b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

template <class V>
HWY_INLINE auto widened(Vec<V> v) {
  return Vec<decltype(widened(v.x))>{widened(v.x), widened(v.y), widened(v.z)};
}
template <class V>
HWY_INLINE auto narrowed(Vec<V> v) {
  return Vec<decltype(narrowed(v.x))>{narrowed(v.x), narrowed(v.y), narrowed(v.z)};
}

template <class V, class Real>
HWY_INLINE Vec<V> load(Field<Real> f, std::size_t at) {
  return {load<V>(f.x + at), load<V>(f.y + at), load<V>(f.z + at)};
}

template <class V, class Real>
HWY_INLINE void store(Field<Real> f, std::size_t at, const Vec<V>& v) {
  store(f.x + at, v.x);
  store(f.y + at, v.y);
  store(f.z + at, v.z);
}

}  // namespace simd
}  // namespace HWY_NAMESPACE

#if HWY_ONCE
using namespace HWY_NAMESPACE;
#endif

}  // namespace softbody
HWY_AFTER_NAMESPACE();

#endif  // include guard
