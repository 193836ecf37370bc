#pragma once
// What the machine takes for the least that a stage has to do.

#include <cstddef>

#include "collide/core/workers.h"

namespace stages {

/// Returns the time (ns) per byte that is read or written, of a pass x += h v of one thread over arrays of `bytes` in
/// all.
double stream_ns(std::size_t bytes);
/// Returns the time (ns) of one square root and one quotient of a number, in full registers. All threads take as many.
double root_and_quotient_ns(collide::Workers& workers);

}  // namespace stages
