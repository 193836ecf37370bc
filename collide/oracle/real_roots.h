#pragma once
// Real roots of polynomials with integer coefficients, and signs of other polynomials there, without rounding (Basu,
// Pollack and Roy, Algorithms in Real Algebraic Geometry, chapters 2 and 10). No root is approximated to find a sign.
//
// A polynomial on an interval of time is the sum of c[k] t^k (1 - t)^(N - k), where t runs from 0 to 1 over the
// interval (scaled Bernstein form). Divided by (1 - t)^N > 0, it is the sum of c[k] x^k for x = t / (1 - t). So on the
// open interval it has the signs of an ordinary polynomial for x > 0.

#include <utility>
#include <vector>

#include "collide/oracle/exact_arithmetic.h"

namespace collide::oracle {

using Coefficients = std::vector<Integer>;

/// A part of the time 0 .. 1: from start / 2^halvings to (start + 1) / 2^halvings.
struct TimePiece {
  Integer start = 0;
  unsigned halvings = 0;
};

/// A root in 0 .. 1: the start of the piece if the polynomial is empty, else the only root of the polynomial inside the
/// open piece, and a simple one. The coefficients are those on the piece.
struct Root {
  TimePiece piece;
  Coefficients polynomial;
};

/// Returns all different roots in 0 .. 1, the least first. Precondition: a coefficient is not 0.
std::vector<Root> roots_of(Coefficients polynomial);

/// Returns the sign of a polynomial at the root. Precondition: its coefficients are those on the piece of the root.
int sign_at(const Root& root, Coefficients polynomial);

/// Returns two times not farther apart than 2^-41 with the root between them, or one of them the root.
std::pair<double, double> enclosure_of(Root root);

}  // namespace collide::oracle
