#include "collide/oracle/real_roots.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace collide::oracle {

namespace {

void drop_leading_zeros(Coefficients& c) {
  while (!c.empty() && c.back() == 0) c.pop_back();
}

/// Drops the roots at both ends of the interval.
void drop_roots_at_ends(Coefficients& c) {
  drop_leading_zeros(c);
  c.erase(c.begin(), std::find_if(c.begin(), c.end(), [](const Integer& x) { return x != 0; }));
}

/// Returns the number of sign changes. Descartes' rule: there are as many roots inside the interval, or fewer by an
/// even number.
int sign_changes(const Coefficients& c) {
  int changes = 0, last = 0;
  for (const Integer& x : c) {
    if (x == 0) continue;
    if (sgn(x) == -last) ++changes;
    last = sgn(x);
  }
  return changes;
}

/// Restricts a polynomial to the first half of its interval (de Casteljau's algorithm); multiplies it by 2^N.
Coefficients first_half(Coefficients c) {
  const std::size_t degree = c.size() - 1;
  for (std::size_t last = degree; last > 0; --last) {
    for (std::size_t k = 1; k <= last; ++k) c[k] += c[k - 1];
  }
  for (std::size_t k = 0; k < degree; ++k) c[k] <<= degree - k;
  return c;
}

/// Runs time backwards.
Coefficients reversed(Coefficients c) {
  std::reverse(c.begin(), c.end());
  return c;
}

Coefficients second_half(Coefficients c) { return reversed(first_half(reversed(std::move(c)))); }

/// Returns the remainder of a division by a polynomial in x, times a positive number.
Coefficients remainder(Coefficients a, const Coefficients& divisor) {
  const Integer lead = abs(divisor.back());
  while (a.size() >= divisor.size()) {
    const Integer factor = -sgn(divisor.back()) * a.back();
    a.pop_back();
    for (Integer& x : a) x *= lead;
    const std::size_t shift = a.size() + 1 - divisor.size();
    for (std::size_t k = 0; k + 1 < divisor.size(); ++k) add_product(a[k + shift], factor, divisor[k]);
    drop_leading_zeros(a);
  }
  return a;
}

/// Returns a polynomial with the same roots, each of them simple: the quotient by the greatest common divisor with the
/// derivative.
Coefficients square_free(Coefficients c) {
  Coefficients divisor = c, rest;
  for (std::size_t k = 1; k < c.size(); ++k) rest.push_back(c[k] * static_cast<unsigned>(k));
  while (!rest.empty()) {
    divisor = remainder(std::move(divisor), rest);
    std::swap(divisor, rest);
  }
  Integer content = 0;
  for (const Integer& x : divisor) content = gcd(content, x);
  for (Integer& x : divisor) x /= content;
  // By Gauss's lemma, the quotient by a polynomial without a common factor in its coefficients is one of integers.
  Coefficients quotient(c.size() + 1 - divisor.size());
  for (std::size_t n = quotient.size(); n-- > 0;) {
    quotient[n] = c[n + divisor.size() - 1] / divisor.back();
    for (std::size_t k = 0; k < divisor.size(); ++k) c[n + k] -= quotient[n] * divisor[k];
  }
  return quotient;
}

/// Returns about where inside its piece a root is, 0 .. 1. Rounded; where all of it is lost, the answer is just
/// useless.
double estimate(const Coefficients& polynomial) {
  const auto bits = [](const Integer& x) { return mpz_sizeinbase(x.get_mpz_t(), 2); };
  std::size_t most = 0;
  for (const Integer& x : polynomial) most = std::max(most, bits(x));
  std::vector<double> c;
  for (const Integer& x : polynomial) {
    long exponent;
    const double digits = mpz_get_d_2exp(&exponent, x.get_mpz_t());
    c.push_back(std::ldexp(digits, static_cast<int>(exponent - static_cast<long>(most))));
  }
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double t = (low + high) / 2, s = 1 - t;
    double value = 0, power = 1;
    for (const double x : c) {
      value = value * s + x * power;
      power *= t;
    }
    ((value > 0) == (c.front() > 0) ? low : high) = t;
  }
  return low;
}

/// Returns the sign of a polynomial at step / 2^halvings of its piece.
int sign_at(const Coefficients& polynomial, std::uint64_t step, unsigned halvings) {
  const Integer at = integer_of(step), rest = integer_of((std::uint64_t{1} << halvings) - step);
  Integer value = 0, power = 1;
  for (const Integer& x : polynomial) {
    value *= rest;
    add_product(value, x, power);
    power *= at;
  }
  return sgn(value);
}

/// Shortens the piece of a root to 2^-halvings if it is longer.
void refine(Root& root, unsigned halvings) {
  if (root.polynomial.empty() || root.piece.halvings >= halvings) return;
  const unsigned more = halvings - root.piece.halvings;
  std::uint64_t low = 0, high = std::uint64_t{1} << more;
  const auto narrow = [&](std::uint64_t step) {
    if (step <= low || step >= high) return;
    const int sign = sign_at(root.polynomial, step, more);
    if (sign != -sgn(root.polynomial.front())) low = step;
    if (sign != sgn(root.polynomial.front())) high = step;
  };
  const auto near = static_cast<std::uint64_t>(std::ldexp(estimate(root.polynomial), static_cast<int>(more)));
  narrow(near);
  narrow(near + 1);
  while (high - low > 1) narrow(low + (high - low) / 2);
  root.piece = {(root.piece.start << more) + integer_of(low), halvings};
  if (low == high) root.polynomial.clear();
}

}  // namespace

std::vector<Root> roots_of(Coefficients polynomial) {
  assert(std::any_of(polynomial.begin(), polynomial.end(), [](const Integer& x) { return x != 0; }));
  std::vector<Root> roots;
  if (polynomial.front() == 0) roots.push_back({});
  const bool root_at_end = polynomial.back() == 0;
  drop_roots_at_ends(polynomial);
  if (sign_changes(polynomial) > 1) polynomial = square_free(std::move(polynomial));
  // Ends, because the roots are simple: in pieces that are small beside their distances there is one sign change at
  // most (Vincent's theorem).
  std::vector<Root> pending{{{}, std::move(polynomial)}};  // the earliest last
  while (!pending.empty()) {
    Root root = std::move(pending.back());
    pending.pop_back();
    const int changes = sign_changes(root.polynomial);
    if (root.polynomial.empty() || changes == 1) {
      roots.push_back(std::move(root));
    } else if (changes > 1) {
      Coefficients first = first_half(root.polynomial), second = second_half(std::move(root.polynomial));
      const bool root_between = second.front() == 0;
      drop_roots_at_ends(first);
      drop_roots_at_ends(second);
      const TimePiece before{2 * root.piece.start, root.piece.halvings + 1};
      const TimePiece after{before.start + 1, before.halvings};
      pending.push_back({after, std::move(second)});
      if (root_between) pending.push_back({after, {}});
      pending.push_back({before, std::move(first)});
    }
  }
  if (root_at_end) roots.push_back({{1, 0}, {}});
  return roots;
}

/// Inside the piece, counts by Sturm's theorem the jumps of polynomial / root.polynomial from -oo to +oo, less those
/// from +oo to -oo (its Cauchy index). The only one that can be there is at the root.
int sign_at(const Root& root, Coefficients polynomial) {
  if (root.polynomial.empty()) return sgn(polynomial.front());
  drop_leading_zeros(polynomial);
  if (sign_changes(polynomial) == 0) return polynomial.empty() ? 0 : sgn(polynomial.back());
  Coefficients a = root.polynomial, b = remainder(std::move(polynomial), a);
  const int rising = sgn(a.back());
  int index = 0, at_start = sgn(a.front()), at_end = sgn(a.back());
  while (!b.empty()) {
    if (sgn(b.front()) == -at_start) ++index;
    if (b.front() != 0) at_start = sgn(b.front());
    if (sgn(b.back()) == -at_end) --index;
    at_end = sgn(b.back());
    a = remainder(std::move(a), b);
    for (Integer& x : a) x = -x;
    std::swap(a, b);
  }
  return rising * index;
}

std::pair<double, double> enclosure_of(Root root) {
  constexpr unsigned halvings = 41, digits = 52;
  refine(root, halvings);
  const bool exact = root.polynomial.empty();
  TimePiece& piece = root.piece;
  // 52 binary places are those of a double below 1.
  const unsigned surplus = piece.halvings > digits ? piece.halvings - digits : 0;
  const Integer low = piece.start >> surplus;
  const bool point = exact && (low << surplus) == piece.start;
  const auto time = [&](const Integer& x) {
    return std::ldexp(x.get_d(), -static_cast<int>(piece.halvings - surplus));
  };
  return {time(low), point ? time(low) : time(low + 1)};
}

}  // namespace collide::oracle
