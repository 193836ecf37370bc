// Arithmetic written once for lanes and for plain numbers: V is one value for each lane, or a float or double. Compiled
// for each of Highway's targets, see state/simd.h.
#if defined(SOFTBODY_STATE_LANE_MATH_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOFTBODY_STATE_LANE_MATH_H
#undef SOFTBODY_STATE_LANE_MATH_H
#else
#define SOFTBODY_STATE_LANE_MATH_H
#endif

#include <cmath>
#include <concepts>

#include "softbody/state/simd.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {
namespace simd {

// As of lanes.
template <std::floating_point T>
HWY_INLINE T square_root(T v) {
  return std::sqrt(v);
}
template <std::floating_point T>
HWY_INLINE T select(bool condition, T a, T b) {
  return condition ? a : b;
}
template <std::floating_point T>
HWY_INLINE T larger(T a, T b) {
  return a > b ? a : b;
}
template <std::floating_point T>
HWY_INLINE T smaller(T a, T b) {
  return a < b ? a : b;
}
template <std::floating_point T>
HWY_INLINE bool any_above(T a, T b) {
  return a > b;
}
template <std::floating_point T>
HWY_INLINE unsigned lanes_above(T a, T b) {
  return a > b;
}
template <std::floating_point T>
HWY_INLINE T select_bits(std::uint64_t bits, T value) {
  return bits & 1 ? value : 0;
}
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
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#endif  // include guard
