#include "collide/oracle/motion_filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "collide/surface/box_tree.h"

namespace collide::oracle {

namespace {

using Answer = Filtered::Answer;

/// Returns true if the boxes of the two features prove that they do not meet.
template <class Kind>
bool boxes_are_separate(const Points& points) {
  surface::MovingBox first, second;
  for (std::size_t k = 0; k < points.size(); ++k)
    (k < Kind::first_size ? first : second).add(points[k].from, points[k].to);
  return !overlap(first, second);
}

/// The filter halves the time of weights at most this often. What is still open then is nearly always so because of
/// rounding.
constexpr int max_halvings = 4;

/// Times d^N, this bounds the rounding error of each coefficient of a polynomial of degree N, where d is the largest
/// coordinate difference. Proof: a coordinate difference is off by at most 5 * 2^-53 d after four halvings. A
/// coefficient of a component between vertices is a sum of 3 of them, one of the side a sum of at most 18 products of
/// 3, one of a weight a sum of at most 216 products of 4. A product and its sums round at most 2, 10 and 19 times more.
/// 3 * (5 + 2) < 2^5, 18 * (15 + 10) < 2^9, 216 * (20 + 19) < 2^14; one binary place more covers products of errors,
/// and that d^N is rounded.
template <std::size_t N>
constexpr double relative_error = N == 1   ? 0x1p-47
                                  : N == 3 ? 0x1p-43
                                           : 0x1p-38;

/// Signs of the coefficients; 0 where rounding leaves it open.
template <std::size_t N>
using Signs = std::array<int, N + 1>;

int sign_beyond(double x, double bound) { return (x > bound) - (x < -bound); }

template <std::size_t N>
double error_of(double largest) {
  double bound = relative_error<N>;
  for (std::size_t degree = 0; degree < N; ++degree) bound *= largest;
  return bound;
}

template <std::size_t N>
Signs<N> signs_of(const Polynomial<double, N>& polynomial, double largest) {
  const double bound = error_of<N>(largest);
  Signs<N> signs;
  for (std::size_t k = 0; k <= N; ++k) signs[k] = sign_beyond(polynomial.c[k], bound);
  return signs;
}
// What holds for all coefficients holds for the polynomial on the whole interval.
template <std::size_t N>
bool all_are(const std::array<int, N>& signs, int sign) {
  return std::all_of(signs.begin(), signs.end(), [&](int s) { return s == sign; });
}

template <class Kind>
bool boxes_are_separate(const FeatureMotion<double>& motion, double largest) {
  const auto& between = Kind::between(motion);
  return std::ranges::any_of(std::array{&Vector<double, 1>::x, &Vector<double, 1>::y, &Vector<double, 1>::z},
                             [&](auto component) {
                               const int side = signs_of(between[0].*component, largest)[0];
                               return side != 0 && std::ranges::all_of(between, [&](const Vector<double, 1>& v) {
                                        return all_are(signs_of(v.*component, largest), side);
                                      });
                             });
}

FeatureMotion<double> half_of(const FeatureMotion<double>& motion, bool second) {
  return with_each(motion, [&](Polynomial<double, 1> x) {
    x.c[second ? 0 : 1] = (x.c[0] + x.c[1]) * 0.5;
    return x;
  });
}

template <class Kind>
Filtered filter(const FeatureMotion<double>& motion, double largest, std::uint64_t start, unsigned halvings) {
  const Signs<3> side = signs_of(Kind::side(motion), largest);
  if (all_are(side, 1) || all_are(side, -1)) return {Answer::apart};
  bool within = true;
  for (const Weight<double>& weight : Kind::weights(motion)) {
    const Signs<4> signs = signs_of(weight, largest);
    if (all_are(signs, -1)) return {Answer::apart};
    within = within && all_are(signs, 1);
  }
  if (std::ranges::count(side, 0) > 0) return {Answer::unknown};
  // By Descartes' rule, a single change of sign is a single root.
  const int changes = (side[0] != side[1]) + (side[1] != side[2]) + (side[2] != side[3]);
  if (within && changes == 1) return {Answer::passing, start, halvings, side[0] > 0};
  if (halvings == max_halvings) return {Answer::unknown};
  for (const unsigned second : {0u, 1u}) {
    const FeatureMotion<double> half = half_of(motion, second != 0);
    if (boxes_are_separate<Kind>(half, largest)) continue;
    const Filtered filtered = filter<Kind>(half, largest, 2 * start + second, halvings + 1);
    if (filtered.answer != Answer::apart) return filtered;
  }
  return {Answer::apart};
}

// ---- near the only root of the side ----

/// Returns about where a cubic is 0 between two times at which its signs differ: Newton's method, or halving where it
/// leads out of these times. before: the sign at the first one.
double estimate_root(const std::array<double, 4>& c, int before, double low, double high) {
  double t = (low + high) / 2;
  for (int i = 0; i < 50; ++i) {
    const double s = 1 - t;
    const double value = s * s * (c[0] * s + c[1] * t) + t * t * (c[2] * s + c[3] * t);
    const double slope = s * s * (c[1] - 3 * c[0]) + 2 * s * t * (c[2] - c[1]) + t * t * (3 * c[3] - c[2]);
    ((value > 0) == (before > 0) ? low : high) = t;
    double next = t - value / slope;
    if (!(low < next && next < high)) next = (low + high) / 2;
    if (std::abs(next - t) < 0x1p-50) return next;
    t = next;
  }
  return t;
}

DoubleDouble value_at(const Polynomial<DoubleDouble, 3>& polynomial, const DoubleDouble& t) {
  const DoubleDouble s = DoubleDouble(1) - t;
  const auto& c = polynomial.c;
  return s * s * (c[0] * s + c[1] * t) + t * t * (c[2] * s + c[3] * t);
}

/// The roundoff of DoubleDouble, 8 * 2^-106, beside that of double.
constexpr double finer = 0x1p-50;

/// Returns the signs of all weights at a time that is off by at most 2^-70; 0 where this leaves it open. Proof: a
/// weight is a sum of at most 36 products of 4 differences, each of which is at most d and moves by at most 2 d *
/// 2^-70. So it is off by at most 36 * 8 * 2^-70 d^4 < 2^-61 d^4; one binary place more covers rounding.
template <class Kind>
auto weight_signs(const FeatureMotion<DoubleDouble>& motion, const DoubleDouble& t, double largest) {
  const auto at = [&](const Polynomial<DoubleDouble, 1>& x) {
    return Polynomial<DoubleDouble, 0>{{x.c[0] * (DoubleDouble(1) - t) + x.c[1] * t}};
  };
  Differences<DoubleDouble, 0> v;
  for (std::size_t k = 0; k < v.size(); ++k) v[k] = {at(motion[k].x), at(motion[k].y), at(motion[k].z)};
  const auto weights = Kind::weights(v);
  const double bound = 0x1p-60 * largest * largest * largest * largest;
  std::array<int, std::tuple_size_v<decltype(weights)>> signs;
  for (std::size_t k = 0; k < signs.size(); ++k) signs[k] = sign_beyond(weights[k].c[0].high, bound);
  return signs;
}

/// Looks where the side is 0, in pairs of doubles. coarse: unknown, or passing; the result if this leaves it open.
template <class Kind>
Filtered close_up(const Points& points, double largest, Filtered coarse) {
  const auto motion = motion_of<Kind, DoubleDouble>(points, [](double x) { return DoubleDouble(x); });
  const Polynomial<DoubleDouble, 3> side = Kind::side(motion);
  const auto& c = side.c;
  const std::array<double, 4> rounded{c[0].high, c[1].high, c[2].high, c[3].high};
  // Twice as much as of a coefficient covers that the value at a time is rounded, too.
  const double bound = 2 * finer * error_of<3>(largest);
  if (coarse.answer == Answer::unknown) {
    int changes = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const int sign = sign_beyond(rounded[k], bound);
      if (sign == 0) return coarse;
      if (k > 0) changes += sign != sign_beyond(rounded[k - 1], bound);
    }
    if (changes == 0) return {Answer::apart};
    if (changes > 1) return coarse;
  }
  constexpr double length = 1.0 / (std::uint64_t{1} << most_halvings);
  const auto time = [&](std::uint64_t step) { return static_cast<double>(step) * length; };
  const auto sign_at = [&](const DoubleDouble& t) { return sign_beyond(value_at(side, t).high, bound); };
  std::uint64_t low = coarse.start << (most_halvings - coarse.halvings);
  std::uint64_t high = (coarse.start + 1) << (most_halvings - coarse.halvings);
  const int before = sign_at(time(low));
  if (before == 0 || sign_at(time(high)) != -before) return coarse;
  auto step = static_cast<std::uint64_t>(estimate_root(rounded, before, time(low), time(high)) / length);
  for (std::uint64_t stride = 1; high - low > 1; stride *= 2) {
    if (step <= low || step >= high) step = low + (high - low) / 2;
    const int sign = sign_at(time(step));
    if (sign == 0) return coarse;
    (sign == before ? low : high) = step;
    step += sign == before ? stride : -stride;
  }
  const Filtered passing{Answer::passing, low, most_halvings, before > 0};
  if (coarse.answer == Answer::passing) return passing;
  const double at_low = value_at(side, time(low)).high, at_high = value_at(side, time(high)).high;
  const DoubleDouble root = DoubleDouble(time(low)) + DoubleDouble(length * (at_low / (at_low - at_high)));
  constexpr double near = 0x1p-70;
  if (sign_at(root - DoubleDouble(near)) != before || sign_at(root + DoubleDouble(near)) != -before) return coarse;
  const auto signs = weight_signs<Kind>(motion, root, largest);
  if (std::ranges::count(signs, -1) > 0) return {Answer::apart};
  return std::ranges::count(signs, 0) > 0 ? coarse : passing;
}

}  // namespace

template <class Kind>
Filtered filter_motion(const Points& points) {
  if (boxes_are_separate<Kind>(points)) return {Answer::apart};
  const FeatureMotion<double> motion = motion_of<Kind, double>(points, [](double x) { return x; });
  double largest = 0;
  for (const Vector<double, 1>& v : motion) {
    for (const Polynomial<double, 1>* component : {&v.x, &v.y, &v.z}) {
      for (const double c : component->c) largest = std::max(largest, std::abs(c));
    }
  }
  // Between these, no power up to the fourth overflows, and what underflows is less than the bounds of the errors.
  if (!(0x1p-200 < largest && largest < 0x1p200)) return {Answer::unknown};
  const Filtered filtered = filter<Kind>(motion, largest, 0, 0);
  return filtered.answer == Answer::apart ? filtered : close_up<Kind>(points, largest, filtered);
}

template Filtered filter_motion<VertexFace>(const Points& points);
template Filtered filter_motion<EdgeEdge>(const Points& points);

}  // namespace collide::oracle
