#pragma once
// The search for what may touch the bodies of a batch in an implicit step.

#include "softbody/integrate/implicit/implicit_steps.h"
#include "softbody/integrate/implicit/moving_axes.h"

namespace softbody {

/// Sets the planes to those of near solids before each particle and near feature of the lanes that have axes, for a
/// step as long as theirs. Returns the lanes in which one would pass its plane if no force acted on it.
LaneMask find_planes(const ImplicitBatch& batch, const MovingAxes& axes, ImplicitBodies& bodies);

/// Sets the penalty pairs to the penalty contacts of the lanes `moving`, for a step of h. Returns the lanes that have
/// one.
LaneMask find_penalty_pairs(const ImplicitBatch& batch, LaneMask moving, double h, ImplicitBodies& bodies);

}  // namespace softbody
