#pragma once
// The search for what may touch the bodies of a batch in an implicit step.

#include "softbody/integrate/implicit/steps.h"

namespace softbody {

/// Sets work.planes to the planes of near solids before each particle and near feature of the lanes `moving`, for a
/// step of h. Returns the lanes in which one would pass its plane if no force acted on it.
LaneMask find_planes(const ImplicitBatch& batch, const ImplicitFrames& frames, LaneMask moving, double h,
                     ImplicitWork& work);

/// Sets work.penalty_pairs to the penalty contacts of the lanes `moving`, for a step of h. Returns the lanes that have
/// one.
LaneMask find_penalty_pairs(const ImplicitBatch& batch, LaneMask moving, double h, ImplicitWork& work);

}  // namespace softbody
