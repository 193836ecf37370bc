#pragma once
// Numbers for exact signs: a double with a bound of its error, rationals and integers, and polynomials and vectors of
// them.

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <gmpxx.h>

namespace collide::oracle {

using Rational = mpq_class;
using Integer = mpz_class;

/// A real number in the interval value - error .. value + error (midpoint-radius interval arithmetic). Products of up
/// to seven differences of floats neither overflow nor underflow, so that rounding is the only error.
struct Bounded {
  double value = 0, error = 0;

  Bounded() = default;
  Bounded(double exact) : value(exact) {}  // NOLINT: implicit, as for Rational
  /// rounded: the result of one operation; propagated: the error that it has from its operands.
  Bounded(double rounded, double propagated)
      : value(rounded), error((propagated + std::abs(rounded) * unit_roundoff) * inflation) {}

  Bounded& operator+=(const Bounded& b) { return *this = *this + b; }
  Bounded& operator-=(const Bounded& b) { return *this = *this - b; }
  friend Bounded operator+(const Bounded& a, const Bounded& b) { return {a.value + b.value, a.error + b.error}; }
  friend Bounded operator-(const Bounded& a, const Bounded& b) { return {a.value - b.value, a.error + b.error}; }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    return {a.value * b.value, std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error};
  }

 private:
  static constexpr double unit_roundoff = 0x1p-53;
  static constexpr double inflation = 1 + 0x1p-48;  // exceeds the rounding errors of the bound itself
};

/// Returns -1, 0 or 1, or nothing if the error bound leaves the sign open.
inline std::optional<int> sign_of(const Bounded& x) {
  if (x.value > x.error) return 1;
  if (x.value < -x.error) return -1;
  if (x.error == 0) return 0;
  return std::nullopt;
}
inline std::optional<int> sign_of(const Rational& x) { return sgn(x); }

template <class T>
void add_product(T& sum, const T& a, const T& b) {
  sum += a * b;
}
/// Without memory for the product.
inline void add_product(Integer& sum, const Integer& a, const Integer& b) {
  mpz_addmul(sum.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
}

/// A polynomial of degree N on 0 <= t <= 1 in scaled Bernstein form: the sum of c[k] t^k (1 - t)^(N - k). In this form,
/// a product is a plain convolution, and by Descartes' rule there are at most as many roots in (0, 1) as sign changes
/// in c.
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
    for (std::size_t j = 0; j <= M; ++j) add_product(product.c[i + j], a.c[i], b.c[j]);
  }
  return product;
}

/// A vector whose components are polynomials of the time; a constant vector if N = 0.
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
