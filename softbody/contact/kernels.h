#pragma once
// The inner loop of contact with solids, over the particles of one batch. Vectorised with Highway, which chooses the
// processor's instruction set at run time; the result is the same on every one.

#include <cstddef>

#include "softbody/contact/solid_arguments.h"

namespace softbody {

/// Acts on the velocities v of the first `used` lanes. Returns the lanes in which the solid acted, as bits.
unsigned act_by_solid(int width, std::size_t used, const SolidArguments& solid, Field<const float> x, Field<float> v);

}  // namespace softbody
