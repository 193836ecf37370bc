#pragma once

#include <cstdint>

namespace softbody {

/// Of a scene file, and of a world that bodies are added to: with more, a small machine would begin to swap.
inline constexpr std::uint64_t max_particles = 4'000'000;

}  // namespace softbody
