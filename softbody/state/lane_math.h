#pragma once
// Arithmetic written once for lanes and for plain numbers: V is one value for each lane, or a float or double.

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "softbody/state/lanes.h"

namespace softbody::body {

SB_INLINE double square_root(double v) { return std::sqrt(v); }
SB_INLINE float square_root(float v) { return std::sqrt(v); }

template <class V>
SB_INLINE V square_root(V v) {
  V r;
  for (int l = 0; l < lanes; ++l) r[l] = std::sqrt(v[l]);
  return r;
}

SB_INLINE DoubleLane square_root(DoubleLane v) {
  for (int l = 0; l < 4; ++l) v.lo[l] = std::sqrt(v.lo[l]), v.hi[l] = std::sqrt(v.hi[l]);
  return v;
}

template <class V>
SB_INLINE V larger(V a, V b) {
  return a > b ? a : b;
}

SB_INLINE DoubleLane larger(const DoubleLane& a, const DoubleLane& b) {
  return {a.lo > b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi};
}

template <class V>
SB_INLINE V smaller(V a, V b) {
  return a < b ? a : b;
}

/// True if a > b in any lane.
template <class V>
SB_INLINE bool any_above(V a, V b) {
  if constexpr (std::is_floating_point_v<V>) {
    return a > b;
  } else {
    const auto above = a > b;
    std::uint64_t word[sizeof above / sizeof(std::uint64_t)], any = 0;
    std::memcpy(word, &above, sizeof above);
    for (const std::uint64_t w : word) any |= w;
    return any != 0;
  }
}

/// Three components for all lanes.
template <class V>
struct Vec {
  V x, y, z;
  SB_INLINE friend Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  SB_INLINE friend Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  SB_INLINE friend Vec operator*(V s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
};

template <class V>
SB_INLINE V dot(Vec<V> a, Vec<V> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class V>
SB_INLINE Vec<V> cross(Vec<V> a, Vec<V> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace softbody::body
