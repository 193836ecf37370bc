#pragma once

#include <cstddef>
#include <cstdint>

namespace softbody {

/// Of a scene file, and of a world that bodies are added to; also the most vertices and the most objects of an OBJ
/// file. With more, a small machine would begin to swap.
inline constexpr std::uint64_t max_particles = 4'000'000;

/// Of a frame, unless the number of substeps is fixed.
inline constexpr int max_substeps = 4000, max_implicit_steps = 1024;

/// Of a body in implicit steps: the matrix grows faster than the springs.
inline constexpr std::size_t max_implicit_particles = 1000;

/// Bodies of one prototype that are solved side by side, one in each SIMD lane.
inline constexpr int lanes = 8;

/// Corners of all faces of an OBJ file together: a closed mesh of triangles with max_particles vertices has 24 million.
inline constexpr std::uint64_t max_file_corners = 8 * max_particles;

/// m, of a scene's tolerance and cell sides.
inline constexpr double min_length = 1e-9, max_length = 1e6;

/// Of a scene: the tolerance in m, and gravity along each axis in m/s^2. With more, steps of light bodies would not
/// stay finite.
inline constexpr double max_tolerance = 10, max_gravity = 1e3;

/// m, the extent of a body's mesh. Products of the areas and volumes of a smaller mesh underflow in floats, and its gas
/// is so stiff for its mass that its substeps could not be counted. The energy of the air around a larger mesh is so
/// large that floats lose all other energies beside it.
inline constexpr double min_body_size = 1e-3, max_body_size = 1e4;

}  // namespace softbody
