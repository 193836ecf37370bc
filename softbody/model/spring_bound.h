#pragma once
// How stiff a net of springs is as a whole.

#include <span>

#include "softbody/model/body_model.h"

namespace softbody {

/// Bound of the largest eigenvalue of a net of springs between `particles` particles, weighted by one of their
/// properties (N/m, or N s/m), in any shape of the net: a spring of stiffness k acts on its ends by no more than k
/// times the identity, and so the net by no more than its graph's Laplacian, whatever the directions of the springs. Of
/// that the largest eigenvalue is found by Lanczos' method; the residual is added (Zhou and Li 2011, "Bounding the
/// spectrum of large Hermitian matrices"), and a hundredth. Never more than Gershgorin's, twice the largest sum of the
/// property over one particle's springs.
double spring_bound(std::size_t particles, std::span<const std::vector<Spring>* const> lists, double Spring::*property);

}  // namespace softbody
