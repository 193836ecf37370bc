#pragma once
// Limits of meshes.

#include <cstdint>

namespace softbody {

/// Largest number of particles of a scene file or a world, and of vertices or objects of an OBJ file. With more, a
/// small machine would begin to swap.
inline constexpr std::uint64_t max_particles = 4'000'000;

/// Largest number of corners of all faces of an OBJ file together. A closed triangle mesh of max_particles vertices has
/// 24 million.
inline constexpr std::uint64_t max_file_corners = 8 * max_particles;

/// Limits of the extent of a body's mesh in m. In floats, products of areas and volumes of a smaller mesh underflow,
/// and its gas is so stiff for its mass that it would need too many substeps. The energy of the air around a larger
/// mesh is so large that floats lose all other energies beside it.
inline constexpr double min_body_size = 1e-3, max_body_size = 1e4;

}  // namespace softbody
