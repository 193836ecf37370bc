#pragma once
// The loops of implicit steps, in double, for one vector of bodies at a time. Included where they are compiled for an
// instruction set.

#include "softbody/kernel_bodies.h"

namespace softbody::body {

/// Solves L L^T x = b in place for all lanes, x = b at first; `z` is room for as much.
SB_INLINE void substitute(const CholeskyFactor& f, double* x, double* z) {
  using V = Lane<double>;
  const std::size_t n = f.place.size();
  for (std::size_t i = 0; i < n; ++i) store(z + f.place[i] * lanes, load(x + i * lanes));
  for (std::size_t c = 0; c < n; ++c) {
    const V known = f.inverse_diagonal[c] * load(z + c * lanes);
    store(z + c * lanes, known);
    for (std::uint32_t e = f.first[c]; e < f.first[c + 1]; ++e) {
      double* below = z + f.row[e] * lanes;
      store(below, load(below) - f.value[e] * known);
    }
  }
  for (std::size_t c = n; c-- > 0;) {
    V sum = load(z + c * lanes);
    for (std::uint32_t e = f.first[c]; e < f.first[c + 1]; ++e) sum -= f.value[e] * load(z + f.row[e] * lanes);
    store(z + c * lanes, f.inverse_diagonal[c] * sum);
  }
  for (std::size_t i = 0; i < n; ++i) store(x + i * lanes, load(z + f.place[i] * lanes));
}

/// Hooke's springs at x, and their dampers for the displacements x - from within the step, along the directions at
/// `ahead`: fixed, so that the damping has a potential.
SB_INLINE void implicit_springs(std::span<const KernelSpring<double>> list, double inverse_h, Field<const double> x,
                                Field<const double> from, Field<const double> ahead, Field<double> f) {
  using V = Lane<double>;
  const V tiny = V{} + 1e-12;  // m
  for (const KernelSpring<double>& s : list) {
    const Vec<V> dx = load(x, s.j) - load(x, s.i);
    const V length = square_root(dot(dx, dx));
    Vec<V> force = (s.stiffness * (length - s.rest) / larger(length, tiny)) * dx;
    if (s.damping > 0) {
      const Vec<V> moved = dx - (load(from, s.j) - load(from, s.i)), along = load(ahead, s.j) - load(ahead, s.i);
      force = force + (s.damping * inverse_h * dot(moved, along) / larger(dot(along, along), tiny * tiny)) * along;
    }
    store(f, s.i, load(f, s.i) + force);
    store(f, s.j, load(f, s.j) - force);
  }
}

/// v = R v, or R^T v if `back`, for each particle; rotation: column c of R at 3 c.
SB_INLINE void turn(std::size_t particles, const double (*rotation)[lanes], bool back, Field<double> v) {
  using V = Lane<double>;
  V r[3][3];  // row, column
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) (back ? r[column][row] : r[row][column]) = load(rotation[3 * column + row]);
  for (std::size_t at = 0; at < particles * lanes; at += lanes) {
    const Vec<V> a = load(v, at);
    store(v, at,
          Vec<V>{r[0][0] * a.x + r[0][1] * a.y + r[0][2] * a.z, r[1][0] * a.x + r[1][1] * a.y + r[1][2] * a.z,
                 r[2][0] * a.x + r[2][1] * a.y + r[2][2] * a.z});
  }
}

/// A sum a lane.
SB_INLINE void inner_product(std::size_t count, const double* a, const double* b, double* result) {
  using V = Lane<double>;
  V sum{};
  for (std::size_t at = 0; at < count * lanes; at += lanes) sum += load(a + at) * load(b + at);
  store(result, sum);
}

/// y += times * a, one factor a lane.
SB_INLINE void add_scaled(std::size_t count, const double* times, const double* a, double* y) {
  const Lane<double> t = load(times);
  for (std::size_t at = 0; at < count * lanes; at += lanes) store(y + at, load(y + at) + t * load(a + at));
}

/// y += times * a, a the same for all lanes.
SB_INLINE void add_scaled_shared(std::size_t count, const double* times, const double* a, double* y) {
  const Lane<double> t = load(times);
  for (std::size_t i = 0; i < count; ++i) store(y + i * lanes, load(y + i * lanes) + t * a[i]);
}

SB_INLINE void inner_product_shared(std::size_t count, const double* a, const double* b, double* result) {
  using V = Lane<double>;
  V sum{};
  for (std::size_t i = 0; i < count; ++i) sum += a[i] * load(b + i * lanes);
  store(result, sum);
}

}  // namespace softbody::body
