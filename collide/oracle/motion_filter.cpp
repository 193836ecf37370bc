#include "collide/oracle/motion_filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace collide::oracle {

namespace {

using Answer = Filtered::Answer;

/// Returns true if an axis separates the boxes of the two features, in the same order at both ends of the motion and
/// therefore at all times.
template <class Kind>
bool boxes_are_separate(const Points& points) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    double min[2][2] = {{inf, inf}, {inf, inf}}, max[2][2] = {{-inf, -inf}, {-inf, -inf}};  // of a feature, at a time
    for (std::size_t k = 0; k < points.size(); ++k) {
      const std::size_t feature = k < Kind::first_size ? 0 : 1;
      for (const std::size_t time : {0u, 1u}) {
        const double x = (time == 0 ? points[k].from : points[k].to)[axis];
        min[feature][time] = std::min(min[feature][time], x);
        max[feature][time] = std::max(max[feature][time], x);
      }
    }
    if (max[0][0] < min[1][0] && max[0][1] < min[1][1]) return true;
    if (max[1][0] < min[0][0] && max[1][1] < min[0][1]) return true;
  }
  return false;
}

/// The filter halves the time at most this often.
constexpr int max_halvings = 8;

/// Times d^N, this bounds the rounding error of each coefficient of a polynomial of degree N, where d is the largest
/// coordinate difference. Proof: a coordinate difference is off by at most 9 * 2^-53 d after eight halvings. A
/// coefficient of a component between vertices is a sum of 3 of them, one of the side a sum of at most 18 products of
/// 3, one of a weight a sum of at most 216 products of 4. A product and its sums round at most 2, 10 and 19 times more.
/// 3 * (9 + 2) < 2^6, 18 * (27 + 10) < 2^10, 216 * (36 + 19) < 2^14; one binary place more covers products of errors,
/// and that d^N is rounded.
template <std::size_t N>
constexpr double relative_error = N == 1   ? 0x1p-46
                                  : N == 3 ? 0x1p-42
                                           : 0x1p-38;

/// Signs of the coefficients; 0 where rounding leaves it open.
template <std::size_t N>
using Signs = std::array<int, N + 1>;

template <std::size_t N>
Signs<N> signs_of(const Polynomial<double, N>& polynomial, double largest) {
  double bound = relative_error<N>;
  for (std::size_t degree = 0; degree < N; ++degree) bound *= largest;
  Signs<N> signs;
  for (std::size_t k = 0; k <= N; ++k) signs[k] = (polynomial.c[k] > bound) - (polynomial.c[k] < -bound);
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
Filtered filter(const FeatureMotion<double>& motion, double largest, unsigned start, unsigned halvings) {
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
  if (within && changes == 1) return {Answer::passing, start, halvings};
  if (halvings == max_halvings) return {Answer::unknown};
  for (const unsigned second : {0u, 1u}) {
    const FeatureMotion<double> half = half_of(motion, second != 0);
    if (boxes_are_separate<Kind>(half, largest)) continue;
    const Filtered filtered = filter<Kind>(half, largest, 2 * start + second, halvings + 1);
    if (filtered.answer != Answer::apart) return filtered;
  }
  return {Answer::apart};
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
  return filter<Kind>(motion, largest, 0, 0);
}

template Filtered filter_motion<VertexFace>(const Points& points);
template Filtered filter_motion<EdgeEdge>(const Points& points);

}  // namespace collide::oracle
