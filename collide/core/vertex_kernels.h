#pragma once
// The loops over the vertices of one body. Vectorised with Highway, which chooses the processor's instruction set at
// run time.

#include <array>
#include <span>

#include "collide/core/aabb.h"
#include "collide/core/vertex_run.h"

namespace collide {

/// The bounding volumes of a body.
struct BodyBounds {
  Aabb box;
  glm::vec3 centre;  // of the box
  float radius;      // m: every vertex is within this distance of the centre, rounding included
  float largest;     // m: the largest absolute value of a coordinate
  bool finite;       // false: a coordinate is not finite, and the rest means nothing
};
BodyBounds measure_bounds(const VertexRun& run);

/// Calls visit(v) for the vertices that fit_affine() uses: a sample that is spread over the body.
inline constexpr Index sample_run = max_lanes;
constexpr Index sample_stride(Index size) { return size < 8 * sample_run ? sample_run : 4 * sample_run; }
template <class Visit>
void for_samples(Index size, const Visit& visit) {
  for (Index first = 0; first + sample_run <= size; first += sample_stride(size)) {
    for (Index v = first; v < first + sample_run; ++v) visit(v);
  }
}

/// An affine map from reference positions X to positions x of a body: x = matrix * X + offset + centre. The mean of the
/// sampled reference positions is the origin.
struct AffineFit {
  std::array<float, 9> matrix;  // by row
  std::array<float, 3> offset;
  float residual;  // m, the root of the greatest residual2
};
/// Fits an affine map by least squares. inverse_moment: the inverse of the sum of X X^T over the samples; 3 x 3,
/// symmetric, by row. Body and reference have the same size, at least sample_run. Writes to residual2 the squared
/// distance (m^2) of each vertex from where the map takes its reference position.
AffineFit fit_affine(const VertexRun& body, const VertexRun& reference, const std::array<float, 9>& inverse_moment,
                     const glm::vec3& centre, std::span<float> residual2);

/// Writes the numbers of the values that are above the limit or NaN to `list`; ascending. Returns how many there are.
/// Precondition: there are at least max_lanes values, and the list has room for max_lanes more than that.
Index list_above(std::span<const float> values, float limit, Index* list);

}  // namespace collide
