#pragma once

#include <cmath>

namespace softbody {

/// gamma of Alexander's method (1977): the length of both its stages over that of the step.
inline const double implicit_stage = 1 - std::sqrt(0.5);

}  // namespace softbody
