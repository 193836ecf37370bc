#pragma once
// The inner loop of the broad phase: a sweep over boxes that are sorted into strips. Vectorised with Highway, which
// chooses the processor's instruction set at run time.

#include <array>
#include <vector>

#include "collide/core/vertex_run.h"

namespace collide::exact {

/// Boxes with their bounding spheres, sorted so that near boxes have near places. The arrays are padded by max_lanes
/// values, so that whole vectors can be read at the end.
struct SweepStrips {
  std::array<std::vector<float>, 3> lo, hi, centre;
  std::vector<float> radius;

  void resize(Index count);
};
/// Appends to `found` every place in [begin, end) whose box is near() box i and whose sphere is within the cutoff (m)
/// of that of box i. Returns how many boxes were near(), whatever their spheres.
Index sweep_strip(const SweepStrips& boxes, Index i, Index begin, Index end, float cutoff, std::vector<Index>& found);

}  // namespace collide::exact
