#include "collide/oracle/real_roots.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

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
    const Integer factor = sgn(divisor.back()) * a.back();
    a.pop_back();
    for (Integer& x : a) x *= lead;
    const std::size_t shift = a.size() + 1 - divisor.size();
    for (std::size_t k = 0; k + 1 < divisor.size(); ++k) a[k + shift] -= factor * divisor[k];
    drop_leading_zeros(a);
  }
  return a;
}

/// Returns a polynomial with the same roots, each of them simple: the quotient by the greatest common divisor with the
/// derivative.
Coefficients square_free(Coefficients c) {
  Coefficients divisor = c, rest;
  for (std::size_t k = 1; k < c.size(); ++k) rest.push_back(c[k] * k);
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

/// Halves the piece of a root until it is at most 2^-halvings long.
void refine(Root& root, unsigned halvings) {
  while (!root.polynomial.empty() && root.piece.halvings < halvings) {
    Coefficients first = first_half(root.polynomial);
    ++root.piece.halvings;
    root.piece.start *= 2;
    if (const int middle = sgn(first.back()); middle == -sgn(first.front())) {
      root.polynomial = std::move(first);
    } else {
      ++root.piece.start;
      root.polynomial = middle == 0 ? Coefficients{} : second_half(std::move(root.polynomial));
    }
  }
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
  const bool point = exact && low << surplus == piece.start;
  const auto time = [&](const Integer& x) {
    return std::ldexp(x.get_d(), -static_cast<int>(piece.halvings - surplus));
  };
  return {time(low), point ? time(low) : time(low + 1)};
}

}  // namespace collide::oracle
