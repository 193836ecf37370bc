#include "app/report/stability/joiners.h"

#include "softbody/snapshot.h"

namespace app {

std::vector<softbody::PairEnergy> shield_energies_with(softbody::World& world,
                                                       std::span<const softbody::BodySource> joiners) {
  if (!world.plan().has(softbody::Stage::contact_response)) return {};
  const softbody::Snapshot before = world.snapshot();
  for (const softbody::BodySource& joiner : joiners) world.add(joiner);
  std::vector<softbody::PairEnergy> pairs = world.pair_energies().next;
  world.restore(before);
  return pairs;
}

}  // namespace app
