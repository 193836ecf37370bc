#pragma once
// Numbers for exact signs: a double with a bound of its error, rationals and integers, and polynomials and vectors of
// them.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <gmpxx.h>

namespace collide::oracle {

using Rational = mpq_class;
using Integer = mpz_class;
/// Returns the number as an Integer, for which GMP has no constructor where an unsigned long has 32 bits.
inline Integer integer_of(std::uint64_t number) {
  Integer result;
  mpz_import(result.get_mpz_t(), 1, 1, sizeof number, 0, 0, &number);
  return result;
}

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

/// A number of twice a double's digits, as a sum of two doubles (double-word arithmetic; Joldes, Muller and Popescu,
/// Tight and Rigorous Error Bounds for Basic Building Blocks of Double-Word Arithmetic, 2017). Sums are off by at most
/// 3 units of 2^-106 of themselves, products by at most 5, unless they overflow or underflow. A sum or difference of
/// two doubles is exact.
struct DoubleDouble {
  double high = 0, low = 0;  // |low| is at most half of the last digit of `high`

  DoubleDouble() = default;
  DoubleDouble(double x) : high(x) {}  // NOLINT: implicit, as for Rational

  DoubleDouble& operator+=(const DoubleDouble& b) { return *this = *this + b; }
  DoubleDouble& operator-=(const DoubleDouble& b) { return *this = *this - b; }
  friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble s = sum(a.high, b.high), t = sum(a.low, b.low), v = ordered_sum(s.high, s.low + t.high);
    return ordered_sum(v.high, t.low + v.low);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble p = product(a.high, b.high);
    return ordered_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
  }

 private:
  DoubleDouble(double h, double l) : high(h), low(l) {}
  static DoubleDouble sum(double a, double b) {
    const double s = a + b, from_b = s - a;
    return {s, (a - (s - from_b)) + (b - from_b)};
  }
  /// Precondition: |a| >= |b|, or a = 0.
  static DoubleDouble ordered_sum(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
  }
  static DoubleDouble product(double a, double b) {
    const DoubleDouble x = halves(a), y = halves(b);
    const double p = a * b;
    return {p, x.low * y.low - (((p - x.high * y.high) - x.low * y.high) - x.high * y.low)};
  }
  /// Returns x as two numbers of at most 26 digits.
  static DoubleDouble halves(double x) {
    const double scaled = x * 0x8000001p0, high = scaled - (scaled - x);
    return {high, x - high};
  }
};

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
