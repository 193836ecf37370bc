#pragma once
// Closed forms that `report theory` compares the solver with. assets/reports/theory.txt has their sources.

#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <string_view>
#include <utility>

#include <glm/vec3.hpp>

namespace app::report::closed_form {

inline constexpr double g = 9.81, pi = std::numbers::pi;  // m/s^2

/// Returns by how much `steps` steps amplify exp(i omega t). key: of an integrator for which has_step() holds.
/// Semi-implicit Euler turns by the same angle as velocity Verlet, but its velocities are half a step behind.
inline std::complex<double> stepped(std::string_view key, double omega_h, double steps) {
  const std::complex<double> z(0, omega_h);
  if (key == "explicit-euler") return std::pow(1.0 + z, steps);
  if (key == "rk4") return std::pow(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))), steps);
  const double angle = 2 * std::asin(omega_h / 2);
  if (key == "velocity-verlet") return std::polar(1.0, angle * steps);
  return std::polar(1 / std::cos(angle / 2), angle * (steps + 0.5));
}
inline bool has_step(std::string_view key) { return key != "xpbd" && key != "implicit"; }

/// Returns the frequency (Hz) that a swing of `frequency` has with steps of h (s).
inline double stepped_frequency(std::string_view key, double frequency, double h) {
  const double omega_h = 2 * pi * frequency * h;
  return std::arg(stepped(key, omega_h, 2) / stepped(key, omega_h, 1)) / (2 * pi * h);
}

/// A sphere of springs k (N/m) and mass m (kg): a membrane of Poisson's ratio 1/3, whose Young's modulus times
/// thickness is 2 k / sqrt 3. The lower of its two swings of degree n >= 2; the gas has the pressure outside.
struct ShellMode {
  int n;
  static constexpr double poisson = 1.0 / 3;
  /// Returns rho omega^2 R^2 / E.
  double square() const {
    const double sum = n * (n + 1) + 1 + 3 * poisson, product = (1 - poisson * poisson) * (n * (n + 1) - 2);
    return (sum - std::sqrt(sum * sum - 4 * product)) / (2 * (1 - poisson * poisson));
  }
  double frequency(double k, double m) const { return std::sqrt(square() * 2 * k / std::sqrt(3.0) / pi / m); }  // Hz
  /// Returns u / w: a point at the angle a from the pole moves outwards by w P_n(cos a), from the pole by u dP_n / da.
  double slide() const { return (2 - (1 - poisson) * square()) / (n * (n + 1)); }
};

/// Returns the frequency (Hz) at which such a sphere breathes about its balance of radius R (m), in which the gas has
/// the pressure P (Pa), dP more than outside.
inline double breathing_frequency(double k, double m, double R, double P, double dP) {
  return std::sqrt((R * (3 * P - 2 * dP) + 2 * std::sqrt(3.0) * k) / pi / m);
}

/// Returns how far (m) the middle of a chain hangs below its ends, which are `span` apart. Its length (m) is more.
inline double catenary_sag(double length, double span) {
  assert(length > span);
  double least = 0, most = 100;  // of u in sinh(u) / u = length / span
  for (int i = 0; i < 60; ++i) {
    const double u = (least + most) / 2;
    (std::sinh(u) / u < length / span ? least : most) = u;
  }
  return span / (2 * least) * (std::cosh(least) - 1);
}

/// Returns the time (s) between two flips of a free rigid body of ascending principal moments I (kg m^2), from its
/// angular velocity (1/s) at any time.
inline double flip_time(const glm::dvec3& I, const glm::dvec3& omega) {
  double energy2 = 0, square = 0;  // twice the energy; angular momentum squared
  for (int i = 0; i < 3; ++i) energy2 += I[i] * omega[i] * omega[i], square += std::pow(I[i] * omega[i], 2);
  double a = (I.z - I.y) * (square - energy2 * I.x), b = (I.y - I.x) * (energy2 * I.z - square);
  if (a < b) std::swap(a, b);  // it turns about the first axis, not about the third
  // The complete elliptic integral of the first kind, by the arithmetic-geometric mean: not every standard library has
  // it.
  double high = 1, low = std::sqrt(1 - b / a);
  for (int i = 0; i < 60; ++i) low = std::sqrt(low * std::exchange(high, (high + low) / 2));
  return pi / high * std::sqrt(I.x * I.y * I.z / a);
}

}  // namespace app::report::closed_form
