#pragma once
// What misses cost in the scene on the screen, found out beside it.

#include "app/compare/price.h"

namespace app::session {

class PriceMonitor {
 public:
  static constexpr std::uint64_t max_vertices = 20'000;  // of a scene; the runs of a larger one would take minutes

  bool on = false;

  /// Takes the figures that are ready, if any. Asks for those of the scene if it is another one than before: another
  /// world or other settings. world: null where recorded frames are played.
  void exchange(const softbody::World* world);
  /// Returns the figures of the scene; nullptr until they are there.
  const compare::Price* price() const { return price_ ? &*price_ : nullptr; }
  /// Returns true if exchange() must be called again, though the world stands still.
  bool awaits_price() const { return on && trial_.has_work(); }

 private:
  std::optional<compare::HowSimulated> asked_;  // what the figures are of, or will be
  std::optional<compare::Price> price_;
  Background<compare::PriceTrial> trial_;
};

}  // namespace app::session
