#include "app/compare/blow_up_monitor.h"

#include <algorithm>

#include <fmt/core.h>

namespace app::compare {

std::optional<BlowUp> BlowUpMonitor::check(const softbody::World& world,
                                           const std::vector<softbody::BodyMeasures>& bodies) {
  const auto lost = std::ranges::find(bodies, false, &softbody::BodyMeasures::finite);
  if (lost != bodies.end()) {
    const auto body = static_cast<softbody::BodyId>(lost - bodies.begin());
    return BlowUp{body, world.frame(), fmt::format("Body {} is no longer finite", body)};
  }
  const std::optional<softbody::EnergyChange> change = energy_.look(world, bodies);
  compared_ = change.has_value();
  if (!change || !change->from_nowhere()) return {};
  return BlowUp{change->body, world.frame(),
                fmt::format("Body {} gained energy from nowhere: all bodies have {:.3g} J more than was put in",
                            change->body, change->gain)};
}

}  // namespace app::compare
