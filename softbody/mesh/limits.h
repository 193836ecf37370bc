#pragma once
// Limits of meshes.

#include <cstddef>
#include <cstdint>

namespace softbody {

/// Of a scene file, and of a world that bodies are added to; also the most vertices and the most objects of an OBJ
/// file. With more, a small machine would begin to swap.
inline constexpr std::uint64_t max_particles = 4'000'000;

/// Corners of all faces of an OBJ file together: a closed mesh of triangles with max_particles vertices has 24 million.
inline constexpr std::uint64_t max_file_corners = 8 * max_particles;

/// m, the extent of a body's mesh. Products of the areas and volumes of a smaller mesh underflow in floats, and its gas
/// is so stiff for its mass that its substeps could not be counted. The energy of the air around a larger mesh is so
/// large that floats lose all other energies beside it.
inline constexpr double min_body_size = 1e-3, max_body_size = 1e4;

}  // namespace softbody
