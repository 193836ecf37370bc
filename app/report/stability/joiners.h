#pragma once
// What bodies bring to the shields when they join a world that is under way.

#include <span>
#include <vector>

#include "softbody/world.h"

namespace app {

/// What pairs of the shield would hold if these bodies were there now, each at its source's position: before a first
/// frame has carried them into others. The world is as it was afterwards.
std::vector<softbody::PairEnergy> shield_energies_with(softbody::World& world,
                                                       std::span<const softbody::BodySource> joiners);

}  // namespace app
