#pragma once

#include <cstdint>

namespace softbody {

/// Of a scene file, and of a world that bodies are added to: with more, a small machine would begin to swap.
inline constexpr std::uint64_t max_particles = 4'000'000;

/// m, of the tolerance and the sides of cells that a scene file gives.
inline constexpr double least_length = 1e-9, most_length = 1e6;

}  // namespace softbody
