#pragma once
// The cutoff: the largest distance of two vertices in contact, rounding included, so that no stage prunes a contact.

#include <cmath>
#include <limits>

namespace collide {

/// Returns the smallest float that is not below the value, or the largest float if there is none.
inline float round_up(double value) {
  constexpr float largest = std::numeric_limits<float>::max();
  if (value >= largest) return largest;
  const auto rounded = static_cast<float>(value);
  return rounded < value ? std::nextafter(rounded, largest) : rounded;
}

/// Returns an upper bound (m) of the true distance of any two vertices that the test
/// squared_distance() < tolerance * tolerance accepts.
///
/// Let D be the true distance, u = 2^-24 the rounding unit and e = 2^-150 the largest error of a product that
/// underflows. A difference and a sum of floats err by the factor 1 - u at most, also when they underflow; a product by
/// 1 - u or by e. So what squared_distance() returns is at least
///     (1-u)^2 [ (1-u)^3 D^2 - 3e ],   hence   D^2 < (tolerance2 + 3e) / (1-u)^5,   D < sqrt(tolerance2 + 3e) (1 + 3u).
/// The factor below leaves another u for the arithmetic in double. This holds at any coordinates, since nothing in it
/// depends on their size. tolerance: as Settings allow it.
inline float contact_cutoff(float tolerance) {
  const float tolerance2 = tolerance * tolerance;
  return round_up(std::sqrt(double{tolerance2} + 3 * 0x1p-150) * (1 + 4 * 0x1p-24));
}

}  // namespace collide
