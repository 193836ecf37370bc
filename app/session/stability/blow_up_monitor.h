#pragma once
// Checks a world frame by frame and names a body that blew up: one that is no longer finite, or has energy that nothing
// there could give, or a speed that nothing there could reach. The size of a body needs no test of its own: its springs
// store the energy of a large body.

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "softbody/world/measures.h"

namespace app::session {

struct BlowUp {
  softbody::BodyId body;
  int frame;         // the first bad frame that was checked
  std::string what;  // one sentence that names the body
};

class BlowUpMonitor {
 public:
  /// The number of checks within which contacts return the energy that they store.
  static constexpr std::size_t memory = 60;
  /// The largest energy gain that is no blow-up, as a share of the energy that moves and deforms bodies and of m g R.
  /// The shipped scenes, under any user action, gain up to 0.04, which their contacts stored before.
  static constexpr double max_gain = 0.1;
  /// The largest speed that is no blow-up, in multiples of what a body could reach if its particles shared its energy
  /// evenly. The shipped scenes reach 0.9. Gas that is suddenly set to its highest pressure drives some particles to
  /// 1.55, with steps of any length.
  static constexpr double max_speed_factor = 2;
  /// The depth in a solid, in radii of the body, from which on a body counts as pushed: a solid that was put where the
  /// body is pushes it out with energy that no earlier check has seen. A body that moves against a solid stays outside.
  static constexpr double max_depth = 1e-3;
  /// m/s: where nothing moves, rounding moves bodies far more slowly than this.
  static constexpr double rounding_velocity = 1e-3;

  /// Checks a frame; `bodies` were measured in it. Returns the blow-up, if any. It starts anew if bodies are added or
  /// removed, and if a body is held or let go: one that was held out of balance springs back with energy that no
  /// earlier check has seen. Surfaces that overlap at the start separate with energy that nobody has put in. Until they
  /// are separate, for at most `memory` checks, energy is not judged.
  std::optional<BlowUp> check(const softbody::World& world, const std::vector<softbody::BodyMeasures>& bodies);
  /// Starts anew with the next check, because the user has changed something.
  void restart() { recent_.clear(); }
  /// Returns true if the last check had an earlier one to compare with.
  bool compared() const { return recent_.size() > 1; }

 private:
  struct FrameTotals {
    double energy = 0;    // J, of all bodies
    double active = 0;    // J, of their motion and deformation
    double speed = 0;     // m/s, of the fastest particle
    double bounce = 0;    // m/s, the speed that a body can gain by springing back to its shape
    bool pushed = false;  // a body is deep in a solid, or surfaces that overlapped at the start still separate
  };
  void begin(const softbody::World& world, std::size_t bodies);
  void add_contact_energy(const softbody::World& world, FrameTotals& first) const;
  void update_separating(const softbody::World& world, FrameTotals& now);
  FrameTotals totals_of(const std::vector<softbody::BodyMeasures>& bodies) const;
  FrameTotals recent_maximum() const;
  std::optional<BlowUp> find_blow_up(const FrameTotals& now, const std::vector<softbody::BodyMeasures>& bodies,
                                     int frame) const;
  softbody::BodyId body_with_largest_gain(const std::vector<softbody::BodyMeasures>& bodies) const;

  std::deque<FrameTotals> recent_;          // of at most `memory` checks, the latest last
  std::size_t held_count_ = 0;              // bodies that are held
  int separating_ = 0;                      // checks that overlapping surfaces may still take to separate
  std::vector<double> last_energy_;         // J, by body, at the last check
  std::vector<double> rest_energy_, mass_;  // J, of the starting shape; kg; by body
  std::vector<double> max_depth_;           // m, by body
  double fall_energy_ = 0;                  // J, sum of m |g| R
  double fall_speed_ = 0;                   // m/s, that gravity adds within `memory` checks
};

}  // namespace app::session
