#pragma once
// Boxes in strips, and the sweep along one, in the widest instructions of the processor (chosen at run time).

#include <array>
#include <vector>

#include "collide/core/vertex_run.h"

namespace collide::exact {

/// Boxes in an order in which those near each other are close: of each one its bounds on the axes and the sphere around
/// its centre. Padded, so that blocks can be read at the end.
struct SweepStrips {
  std::array<std::vector<float>, 3> lo, hi, centre;
  std::vector<float> radius;
  Index size = 0;

  void resize(Index count);
};
/// Appends every box from the place `begin` on, and before `end`, that is near() box i and whose sphere is within reach
/// of its own. Returns how many were near(), whatever their spheres.
Index sweep_strip(const SweepStrips& boxes, Index i, Index begin, Index end, float reach, std::vector<Index>& found);

}  // namespace collide::exact
