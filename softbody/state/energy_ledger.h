#pragma once
// The ledger of energy. Whoever does work on bodies from outside books it here as it acts; gravity and the forces
// inside bodies do not, since measures count their potentials. What only dissipates books nothing. So energy that
// grows by more than what was booked has come from nowhere.

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace softbody {

/// Who books.
enum class WorkBy {
  solids,    // push bodies out
  easing,    // moves bodies as a whole out of solids that they started in
  surfaces,  // of bodies push each other apart
  penalty,   // contact: what its pairs hold at the start of a frame, less what they hold at its end
  hand,
  holds,  // move vertices
  wind,   // but for the drag that bodies would have in calm air, which only dissipates
  steps,  // that become longer or shorter: what EnergyLedger::staggering changes
  user,   // changes between frames; bodies that come and go
};
inline constexpr std::size_t ledger_accounts = 9;

/// The work (J) that was booked since the start of a world. Different threads may book on different accounts.
class EnergyLedger {
 public:
  /// s. Which energy is conserved: the plain one if this is 0. Else velocities belong to the middle of the last
  /// substep, which had this length; then it is the plain one plus what the forces do in half a substep, see
  /// BodyMeasures::conserved().
  double staggering = 0;

  /// Books nothing that is not finite: it would stay, though bodies that are not finite may be removed.
  void book(WorkBy by, double joules) {
    if (std::isfinite(joules)) accounts_[std::size_t(by)] += joules;
  }
  double booked(WorkBy by) const { return accounts_[std::size_t(by)]; }
  double total() const { return std::accumulate(accounts_.begin(), accounts_.end(), 0.0); }

 private:
  std::array<double, ledger_accounts> accounts_{};
};

/// The rule. `gain`: J, by which energy grew beyond the work that was booked meanwhile. active: J, of what moves and
/// deforms bodies; rounding: J, what floats may add. True also if the gain is not a number.
inline bool from_nowhere(double gain, double active, double rounding, double share = 0.1) {
  assert(!(rounding < 0));
  return !(gain <= share * active + rounding);
}

}  // namespace softbody
