#pragma once

#include <cstdint>

namespace softbody {

/// Of a scene file, and of a world that bodies are added to: with more, a small machine would begin to swap.
inline constexpr std::uint64_t max_particles = 4'000'000;

/// m, of the tolerance and the sides of cells that a scene file gives.
inline constexpr double least_length = 1e-9, most_length = 1e6;

/// m, of a body's mesh. Smaller ones have areas and volumes that floats cannot hold in products, and weigh next to
/// nothing against the gas in them: their substeps could not be counted.
inline constexpr double least_body_size = 1e-3, most_body_size = 1e6;

}  // namespace softbody
