#pragma once
// Arithmetic that reads the same for one value a lane and for a plain double: V is either. Inlined everywhere, so that
// it is compiled for the instruction set of its caller.

#include <cmath>

#include "softbody/lanes.h"

#define SB_INLINE [[gnu::always_inline]] inline

namespace softbody::body {

SB_INLINE double square_root(double v) { return std::sqrt(v); }
SB_INLINE float square_root(float v) { return std::sqrt(v); }

template <class V>
SB_INLINE V square_root(V v) {
  V r;
  for (int l = 0; l < lanes; ++l) r[l] = std::sqrt(v[l]);
  return r;
}

template <class V>
SB_INLINE V larger(V a, V b) {
  return a > b ? a : b;
}

template <class V>
SB_INLINE V smaller(V a, V b) {
  return a < b ? a : b;
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
