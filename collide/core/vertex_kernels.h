#pragma once
// The loops over the vertices of one body, in the widest instructions of the processor (chosen at run time).

#include <array>
#include <span>

#include "collide/core/aabb.h"
#include "collide/core/vertex_run.h"

namespace collide {

/// Where a body is. `radius`: m, every vertex is within it of the box's centre, rounding included.
struct BodyBounds {
  Aabb box;
  glm::vec3 centre;
  float radius;
  float largest;  // the greatest coordinate, whatever its sign
  bool finite;    // if not, the rest means nothing
};
BodyBounds measure_bounds(const VertexRun& run);

/// The vertices that an affine map is fitted to: some of them, spread over the body, are enough. Calls visit(v).
inline constexpr Index sample_run = max_lanes;
constexpr Index sample_stride(Index size) { return size < 8 * sample_run ? sample_run : 4 * sample_run; }
template <class Visit>
void for_samples(Index size, const Visit& visit) {
  for (Index first = 0; first + sample_run <= size; first += sample_stride(size)) {
    for (Index v = first; v < first + sample_run; ++v) visit(v);
  }
}

/// An affine map of reference positions that is fitted to a body: x = matrix * X + offset + centre. The mean of the
/// reference's samples is the origin.
struct AffineFit {
  std::array<float, 9> matrix;  // by row
  std::array<float, 3> offset;
  float residual;  // m, the root of the greatest residual2
};
/// inverse_moment: 3 x 3, symmetric, by row, of the sum of X X^T over the samples. Sizes are equal, at least
/// sample_run. residual2: the squared distance of each vertex from where the map takes its reference, as computed.
AffineFit fit_affine(const VertexRun& body, const VertexRun& reference, const std::array<float, 9>& inverse_moment,
                     const glm::vec3& centre, std::span<float> residual2);

/// The numbers of those values that are not at most the limit, ascending; returns how many. The list has room for
/// max_lanes more than there are values, of which there are at least so many.
Index list_above(std::span<const float> values, float limit, Index* list);

}  // namespace collide
