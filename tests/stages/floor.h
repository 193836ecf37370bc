#pragma once
// What the machine takes for the least that a stage has to do, on one thread.

#include <cstddef>

namespace stages {

/// Returns the time (ns) per byte that is read or written, of a pass x += h v over arrays of `bytes` in all.
double stream_ns(std::size_t bytes);
/// Returns the time (ns) of one square root and one quotient of a number, in full registers.
double root_and_quotient_ns();

}  // namespace stages
