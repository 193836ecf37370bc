#include "softbody/integrate/integrators.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "softbody/integrate/integrator_steps.h"
#include "softbody/mechanics/bound.h"

namespace softbody {
namespace {

/// What a step is bound by: the fastest swing of s^2 + gamma s + omega^2 = 0, doubled as in stable_step().
struct FastestMode {
  FastestMode(double k_m, double c_m) : omega2(2 * k_m), gamma(2 * c_m) {}
  double omega2, gamma;  // 1/s^2 and 1/s
  /// The largest |s| of its two roots.
  double rate() const {
    const double overdamped = gamma * gamma / 4 - omega2;
    return overdamped > 0 ? gamma / 2 + std::sqrt(overdamped) : std::sqrt(omega2);
  }
};

constexpr double safety = 0.8;
constexpr double max_step = 1e9;  // s, where nothing swings

/// |1 + h s| <= 1: h <= gamma / omega^2, and 2 / |s| if overdamped. What is hardly damped grows at every step: then by
/// no more than a factor of e in energy a second. Modes that tension and gas stiffen, too, have less damping for their
/// stiffness than the springs alone: a third is what balls that are let loose far from balance lose energy with.
double explicit_euler_step(double k_m, double c_m) {
  constexpr double min_damped = 1.0 / 3;
  const FastestMode mode(k_m, c_m);
  if (mode.rate() <= 0) return safety * max_step;
  const double damped = min_damped * mode.gamma;
  return safety * std::min(mode.omega2 > 0 ? std::max(damped, 1.0) / mode.omega2 : max_step, 2 / mode.rate());
}

/// The region of stability holds the left half of the disc of this radius (its border meets the real axis at -2.785 and
/// the imaginary one at 2.828).
double runge_kutta_4_step(double k_m, double c_m) {
  const double rate = FastestMode(k_m, c_m).rate();
  return safety * (rate > 0 ? 2.78 / rate : max_step);
}

double unconditional(double, double) { return std::numeric_limits<double>::infinity(); }

constexpr std::array all_integrators{
    Integrator{.key = "auto",
               .name = "Auto",
               .summary = "Takes as many steps of semi-implicit Euler as are stable, of IMEX Euler if only gas would "
                          "need more, or an implicit step if that is cheaper.",
               .order = 1,
               .advance = semi_implicit_euler,
               .stable_step = stable_step,
               .automatic = true},
    Integrator{.key = "explicit-euler",
               .name = "Explicit Euler",
               .summary = "Takes position and velocity from the old state. It gains energy unless the steps are tiny.",
               .order = 1,
               .advance = explicit_euler,
               .stable_step = explicit_euler_step,
               .by_damping = true},
    Integrator{.key = "semi-implicit-euler",
               .name = "Semi-implicit Euler",
               .summary = "Moves positions by the new velocity. It is cheap, and robust below its stability bound.",
               .order = 1,
               .advance = semi_implicit_euler,
               .stable_step = stable_step,
               .choosable = true,
               .staggered = true,
               .conserves_spin = true},
    Integrator{.key = "imex-euler",
               .name = "IMEX Euler",
               .summary =
                   "Semi-implicit Euler, but implicit where gas resists a change of the volume: far fewer steps, "
                   "and no breathing.",
               .order = 1,
               .advance = imex_euler,
               .stable_step = stable_step,
               .choosable = true,
               .implicit_volume = true,
               .staggered = true,
               .conserves_spin = true},
    Integrator{.key = "velocity-verlet",
               .name = "Velocity Verlet",
               .summary = "Second order at the price of semi-implicit Euler. Dampers use a predicted velocity.",
               .order = 2,
               .advance = velocity_verlet,
               .stable_step = stable_step,
               .scratch = 1,
               .conserves_spin = true},
    Integrator{.key = "rk4",
               .name = "Runge-Kutta 4",
               .summary = "Fourth order with four evaluations per step: accurate if nothing is stiff.",
               .order = 4,
               .advance = runge_kutta_4,
               .stable_step = runge_kutta_4_step,
               .scratch = 4},
    Integrator{
        .key = "xpbd",
        .name = "XPBD",
        .summary =
            "Position-based dynamics with compliance and 20 substeps. It never explodes, but converges slowly if "
            "bodies are stiff.",
        .order = 1,
        .advance = xpbd,
        .stable_step = unconditional,
        .substeps_per_step = 20,
        .scratch = 1,
        .projects = true,
        .conserves_energy = false},
    Integrator{.key = "implicit",
               .name = "Implicit",
               .summary =
                   "Quasi-Newton solver with a prefactored matrix, stable at any stiffness. It is backward Euler in "
                   "contact, else of second order.",
               .order = 2,
               .advance = implicit_step,
               .stable_step = unconditional,
               .step_lengths = 1,  // each needs a matrix
               .scratch = 2,
               .implicit = true,
               .choosable = true},
};

}  // namespace

std::span<const Integrator> integrators() { return all_integrators; }

const Integrator* find_integrator(std::string_view key) {
  for (const Integrator& i : all_integrators)
    if (i.key == key) return &i;
  return nullptr;
}

const Integrator& choosable_integrator(bool implicit, bool implicit_volume) {
  const auto found = std::ranges::find_if(all_integrators, [&](const Integrator& i) {
    return i.choosable && i.implicit == implicit && i.implicit_volume == implicit_volume;
  });
  assert(found != all_integrators.end());
  return *found;
}

const Integrator& IntegratorChoice::integrator() const {
  const Integrator* found = find_integrator(key);
  assert(found);
  return *found;
}

std::string integrator_keys() {
  std::string keys;
  for (const Integrator& i : all_integrators) keys.append(keys.empty() ? "" : ", ").append(i.key);
  return keys;
}

}  // namespace softbody
