#pragma once
// Contacts between surfaces, as a world shows them.

#include <array>

#include <glm/vec3.hpp>

#include "softbody/state/body.h"

namespace softbody {

/// A contact of two surfaces that pressed in the last substep.
struct SurfaceContactPoint {
  BodyId a, b;                  // of the first and the second side; equal if a body touches itself
  std::array<Index, 4> vertex;  // of the simulated meshes
  std::array<float, 4> weight;  // of each vertex: those of the first side add up to 1 and give its closest point, those
                                // of the second side add up to -1
  glm::vec3 normal;             // unit, from the second side to the first
};

}  // namespace softbody
