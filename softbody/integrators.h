#pragma once
// The one table of integrators. Each is a function that advances all bodies by one substep through Dynamics'
// operations.

#include <span>
#include <string>
#include <string_view>

namespace softbody {

class Dynamics;

struct Integrator {
  std::string_view key;
  std::string_view name;
  std::string_view summary;
  /// Advances by h seconds; runs on every thread at once, thread being this one's number.
  void (*advance)(Dynamics& dynamics, int thread, float h);
};

std::span<const Integrator> integrators();
/// nullptr if there is no such integrator.
const Integrator* find_integrator(std::string_view key);
std::string integrator_keys();

inline constexpr std::string_view default_integrator = "semi-implicit-euler";

}  // namespace softbody
