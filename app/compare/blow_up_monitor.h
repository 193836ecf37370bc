#pragma once
// Checks a world and names a body that blew up: one that is no longer finite, or that has energy from nowhere. Speed
// and size need no tests of their own: they are energy.

#include <optional>
#include <string>
#include <vector>

#include "softbody/world/energy_watch.h"

namespace app::compare {

struct BlowUp {
  softbody::BodyId body;
  int frame;         // the first bad frame that was checked
  std::string what;  // one sentence that names the body
};

class BlowUpMonitor {
 public:
  /// Compares the world with what it was at the last check; `bodies` are measured in it. Returns the blow-up, if any.
  std::optional<BlowUp> check(const softbody::World& world, const std::vector<softbody::BodyMeasures>& bodies);
  /// Starts anew with the next check, because the world goes back.
  void restart() { energy_.restart(); }
  /// Returns true if the last check had an earlier one to compare with.
  bool compared() const { return compared_; }

 private:
  softbody::EnergyWatch energy_;
  bool compared_ = false;
};

}  // namespace app::compare
