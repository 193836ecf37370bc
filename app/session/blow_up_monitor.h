#pragma once
// Watches a world frame by frame and names the body that blew up: one that is no longer finite, or has energy that
// nothing there could give, or a speed that nothing there could reach. How large a body gets needs no test of its own:
// its springs hold the energy of that.

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "softbody/measures.h"

namespace app {

struct BlowUp {
  softbody::BodyId body;
  int frame;         // the first bad one that was looked at
  std::string what;  // one sentence that names the body
};

class BlowUpMonitor {
 public:
  /// What contacts have stored comes back within so many looks.
  static constexpr std::size_t memory = 60;
  /// More than this share of the energy that moves and deforms bodies, and of m g R, does not appear. The shipped
  /// scenes, whatever is done to them, gain up to 0.04 by what their contacts stored before.
  static constexpr double max_gain = 0.1;
  /// Times what is within reach of a body whose particles share its energy evenly. The shipped scenes get to 0.9; gas
  /// that is suddenly set to its highest pressure drives some particles to 1.55, however short the steps.
  static constexpr double max_speed_factor = 2;
  /// Of a body's radius: deeper in a solid, which came where the body was, it is pushed out with energy that no look
  /// has seen. What meets a solid as it moves stays outside.
  static constexpr double max_depth = 1e-3;
  /// m/s: where nothing moves, rounding moves bodies far more slowly than that.
  static constexpr double rounding_velocity = 1e-3;

  /// Looks at a frame; `bodies` were measured in it. Bodies that come or go begin it anew, and those that are let go or
  /// held: one that was held out of its balance springs back with what no look has seen. Surfaces that lie in each
  /// other as it begins come apart with energy that nobody has put in: until they have, for `memory` looks at most,
  /// none is judged.
  std::optional<BlowUp> look(const softbody::World& world, const std::vector<softbody::BodyMeasures>& bodies);
  /// The user has changed something: energy counts from the next look on.
  void restart() { recent_.clear(); }
  /// Whether the last look had one before it to be held against.
  bool judged() const { return recent_.size() > 1; }

 private:
  struct FrameTotals {
    double energy = 0;    // J, of all bodies
    double active = 0;    // J, of their motion and deformation
    double speed = 0;     // m/s, of the fastest particle
    double bounce = 0;    // m/s, that a body can give itself by springing back to its shape
    bool pushed = false;  // a body is deep in a solid, or surfaces in each other as the guard began
  };
  void begin(const softbody::World& world, std::size_t bodies);
  void add_contact_energy(const softbody::World& world, FrameTotals& first) const;
  void update_separating(const softbody::World& world, FrameTotals& now);
  FrameTotals totals_of(const std::vector<softbody::BodyMeasures>& bodies) const;
  FrameTotals recent_maximum() const;
  std::optional<BlowUp> judge(const FrameTotals& now, const std::vector<softbody::BodyMeasures>& bodies,
                              int frame) const;
  softbody::BodyId body_with_largest_gain(const std::vector<softbody::BodyMeasures>& bodies) const;

  std::deque<FrameTotals> recent_;   // of late
  std::size_t held_count_ = 0;       // bodies
  int separating_ = 0;               // looks that surfaces may still take to come apart, with energy from nowhere
  std::vector<double> last_energy_;  // J, at the last look
  std::vector<double> rest_energy_, mass_;  // J of the starting shape, and kg
  std::vector<double> max_depth_;           // m, of each body
  double fall_energy_ = 0;                  // J: m |g| R of all
  double fall_speed_ = 0;                   // m/s, that it adds within memory
};

}  // namespace app
