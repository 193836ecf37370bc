#pragma once
// Stiffness of a net of springs as a whole.

#include <span>

#include "softbody/model/body_model.h"

namespace softbody {

/// Returns an upper bound of the largest eigenvalue of a net of springs between `particles` particles, in any shape of
/// the net. The springs are weighted by one of their properties (N/m, or N s/m). A spring of stiffness k acts on its
/// ends by no more than k times the identity, whatever its direction, so the net acts by no more than the Laplacian of
/// its graph. Lanczos' method finds the largest eigenvalue of the Laplacian. The residual (Zhou and Li 2011, "Bounding
/// the spectrum of large Hermitian matrices") and one per cent are added. The result is never more than Gershgorin's
/// bound, twice the largest sum of the property over the springs of one particle.
double spring_bound(std::size_t particles, std::span<const std::vector<Spring>* const> lists, double Spring::*property);

}  // namespace softbody
