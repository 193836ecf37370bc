#pragma once
// Numbers for exact signs: a double that knows its own error, rationals, and polynomials and vectors of either.

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <gmpxx.h>

namespace collide::oracle {

using Rational = mpq_class;

/// A real number known to lie within value - error .. value + error. Products of up to seven differences of floats
/// neither overflow nor underflow, so that rounding is the only error there is.
struct Bounded {
  double value = 0, error = 0;

  Bounded() = default;
  Bounded(double exact) : value(exact) {}  // NOLINT: converts as a double does, and as it does to Rational
  Bounded(double rounded, double before) : value(rounded), error((before + std::abs(rounded) * unit) * grow) {}

  Bounded& operator+=(const Bounded& b) { return *this = *this + b; }
  Bounded& operator-=(const Bounded& b) { return *this = *this - b; }
  friend Bounded operator+(const Bounded& a, const Bounded& b) { return {a.value + b.value, a.error + b.error}; }
  friend Bounded operator-(const Bounded& a, const Bounded& b) { return {a.value - b.value, a.error + b.error}; }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    return {a.value * b.value, std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error};
  }

 private:
  static constexpr double unit = 0x1p-53;      // half a unit in the last place
  static constexpr double grow = 1 + 0x1p-48;  // more than the roundings of the bound itself can take away
};

/// -1, 0 or 1, or nothing where the error leaves it open.
inline std::optional<int> sign_of(const Bounded& x) {
  if (x.value > x.error) return 1;
  if (x.value < -x.error) return -1;
  if (x.error == 0) return 0;
  return std::nullopt;
}
inline std::optional<int> sign_of(const Rational& x) { return sgn(x); }

/// A polynomial of degree N on 0 <= t <= 1 in scaled Bernstein form: sum of c[k] t^k (1 - t)^(N - k). A product is then
/// a plain convolution; by Descartes' rule the roots within (0, 1) are no more than the changes of sign of c.
template <class T, std::size_t N>
struct Polynomial {
  std::array<T, N + 1> c{};

  friend Polynomial operator+(Polynomial a, const Polynomial& b) {
    for (std::size_t k = 0; k <= N; ++k) a.c[k] += b.c[k];
    return a;
  }
  friend Polynomial operator-(Polynomial a, const Polynomial& b) {
    for (std::size_t k = 0; k <= N; ++k) a.c[k] -= b.c[k];
    return a;
  }
};
template <class T, std::size_t N, std::size_t M>
Polynomial<T, N + M> operator*(const Polynomial<T, N>& a, const Polynomial<T, M>& b) {
  Polynomial<T, N + M> product;
  for (std::size_t i = 0; i <= N; ++i) {
    for (std::size_t j = 0; j <= M; ++j) product.c[i + j] += a.c[i] * b.c[j];
  }
  return product;
}

/// A vector that moves: its components are polynomials of the time. N = 0: it stands still.
template <class T, std::size_t N>
struct Vector {
  Polynomial<T, N> x, y, z;

  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
};
template <class T, std::size_t N, std::size_t M>
Polynomial<T, N + M> dot(const Vector<T, N>& a, const Vector<T, M>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T, std::size_t N, std::size_t M>
Vector<T, N + M> cross(const Vector<T, N>& a, const Vector<T, M>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace collide::oracle
