#pragma once
// Contacts between bodies, as a world shows them.

#include <array>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "collide/core/detector.h"
#include "softbody/state/body.h"

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

/// A contact of two surfaces that pressed in the last substep.
struct SurfaceContactPoint {
  BodyId a, b;                  // of the first and the second side; equal if a body touches itself
  std::array<Index, 4> vertex;  // over the whole world
  std::array<float, 4> weight;  // of each vertex: those of the first side add up to 1 and give its closest point, those
                                // of the second side add up to -1
  glm::vec3 normal;             // unit, from the second side to the first
};

}  // namespace softbody
