#pragma once
// The energy of penalty contact, as a world shows it.

#include <span>
#include <vector>

#include "collide/core/detector.h"

namespace softbody {

/// The energy that the penalty force between two vertices stores.
struct PairEnergy {
  collide::Contact contact;
  double joules;
};
double total(std::span<const PairEnergy> pairs);  // J

/// Pairs of vertices of which at least one moves, ascending by contact.
struct PairEnergies {
  std::vector<PairEnergy> last;  // the pairs that acted in the last step, as it left them
  std::vector<PairEnergy> next;  // the pairs of the last detection, which will act in the next step
};

}  // namespace softbody
