#pragma once
// Watches a world for energy from nowhere: compares what its bodies have with what was booked, by the rule of the
// ledger (state/energy_ledger.h).

#include <optional>
#include <vector>

#include "softbody/state/energy_ledger.h"
#include "softbody/world/measures.h"

namespace softbody {

/// What has happened between two looks at a world.
struct EnergyChange {
  double gain;      // J, by which the energy grew beyond the work booked; negative: energy was lost
  double active;    // J, of motion and deformation
  double rounding;  // J
  BodyId body;      // the one that gained most
  bool conserved;   // by the integrator; else a gain says nothing
  bool from_nowhere() const { return conserved && softbody::from_nowhere(gain, active, rounding); }
};

class EnergyWatch {
 public:
  /// Returns what has happened since the last look; nothing at the first one. bodies: as measure_bodies() returns them
  /// now. The energy is the one that is conserved, see EnergyLedger::staggering.
  std::optional<EnergyChange> look(const World& world, const std::vector<BodyMeasures>& bodies);
  /// Starts anew with the next look: the world goes back.
  void restart() { last_.reset(); }

 private:
  struct Look {
    std::vector<std::uint32_t> numbers;  // of the bodies, see BodyState; ascending
    std::vector<double> energies;        // J, theirs
    double booked, active;               // J; the latter of motion and deformation
    bool conserved;                      // by the integrator
  };
  std::optional<Look> last_;
};

}  // namespace softbody
