#pragma once
// The one table of integrators. Each is a function that advances all bodies by one substep through Dynamics'
// operations, so that all share the same forces and contacts.

#include <span>
#include <string>
#include <string_view>

namespace softbody {

class Dynamics;

struct Substep {
  float h;     // s
  bool first;  // of its frame: forces that are remembered from before may be out of date
};

struct Integrator {
  std::string_view key;
  std::string_view name;
  std::string_view summary;
  int order;  // of convergence for smooth motion
  /// Advances by one substep; runs on every thread at once, thread being this one's number.
  void (*advance)(Dynamics& dynamics, int thread, const Substep& substep);
  /// Largest stable step times 0.8 in s, for sums of stiffness/mass (1/s^2) and of damping/mass (1/s) at one particle;
  /// infinite for what is stable at any step. See stable_step() in prototype.h.
  double (*stable_step)(double k_m, double c_m);
  int substeps = 1;         // that belong to the method: of every step asked for
  int scratch = 0;          // copies of a field over all particles that it needs
  bool implicit = false;    // solves with the matrices of implicit_matrix.h
  bool automatic = false;   // chooses another one for each frame, see Dynamics::choose()
  bool by_damping = false;  // stable only where all that swings is damped enough
  bool staggered = false;   // velocities belong to the middle of the last substep
  bool keeps_spin = false;  // conserves the angular momentum of a free body but for rounding; all do the linear one
};

std::span<const Integrator> integrators();
/// nullptr if there is no such integrator.
const Integrator* find_integrator(std::string_view key);
std::string integrator_keys();

inline constexpr std::string_view default_integrator = "auto";

}  // namespace softbody
