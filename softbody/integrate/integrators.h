#pragma once
// The one table of integrators. Each is a function that advances all bodies by one substep. It calls the operations of
// Motion, so that all integrators share the same forces and contacts.

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace softbody {

class Motion;
struct BatchShare;

struct Substep {
  float h;     // s
  bool first;  // of its frame: forces kept from the frame before may be out of date
};

/// Shares of the longest stable step that are kept back. The stiffness of gas changes with the shape within a frame.
/// The bound of pairs holds in any shape: where gas asks for nothing, half of the reserve will do.
inline constexpr double gas_reserve = 0.2, gasless_reserve = 0.1;

struct Integrator {
  std::string_view key;
  std::string_view name;
  std::string_view summary;
  int order;  // of convergence for smooth motion
  /// Advances all bodies by one substep. All threads call it at once; `share` says what the calling one does.
  void (*advance)(Motion& motion, const BatchShare& share, const Substep& substep);
  /// Returns 0.8 times the largest stable step in s, for the sums of stiffness/mass (1/s^2) and damping/mass (1/s) at
  /// one particle; infinity if every step is stable. See stable_step() in mechanics/bound.h.
  double (*stable_step)(double k_m, double c_m);
  int substeps_per_step = 1;     // that the method makes of each step asked for, and of a frame at least
  int step_lengths = 8;          // in use between a length and its double, unless steps are fixed
  int scratch = 0;               // copies of a field over all particles that it needs
  bool implicit = false;         // solves with the matrices of implicit/matrix.h
  bool automatic = false;        // chooses another integrator for each frame, see StepController
  bool choosable = false;        // may be chosen for a frame: one explicit, one with an implicit volume, one implicit
  bool implicit_volume = false;  // forces that depend on the volume do not bound its steps
  bool by_damping = false;       // is stable only if every oscillation is damped enough
  bool staggered = false;        // its velocities belong to the middle of the last substep
  bool projects = false;         // moves particles to where forces have them, see Plan::unprojected()
  bool conserves_energy = true;  // as steps get short; else it moves bodies to shapes of its own, by its steps
  bool conserves_spin = false;   // conserves a free body's angular momentum up to rounding; all conserve the linear one

  /// Returns the share of the longest stable step that stable_rate() keeps back.
  double reserve() const { return implicit_volume ? gasless_reserve : gas_reserve; }
  bool stable_at_any_step() const { return std::isinf(stable_step(1, 0)); }
};

std::span<const Integrator> integrators();
/// Returns nullptr if there is no such integrator.
const Integrator* find_integrator(std::string_view key);
/// Returns the choosable integrator that takes all forces, or those that depend on the volume, implicitly, or none.
const Integrator& choosable_integrator(bool implicit, bool implicit_volume);
std::string integrator_keys();

inline constexpr std::string_view default_integrator = "auto";

inline constexpr int max_fixed_substeps = 4'000;  // of IntegratorChoice, for who takes it from users

/// An integrator, and how many substeps it takes.
struct IntegratorChoice {
  std::string key{default_integrator};
  std::optional<int> substeps{};  // in a frame, whatever becomes of it; none: as many as the stability bound asks for
  const Integrator& integrator() const;  // of the table; the key must be known
  bool operator==(const IntegratorChoice&) const = default;
};

}  // namespace softbody
