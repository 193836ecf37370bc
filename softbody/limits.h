#pragma once

#include <cstdint>

namespace softbody {

/// Of a scene file, of a world that bodies are added to, and vertices or objects of an OBJ file: with more, a small
/// machine would begin to swap.
inline constexpr std::uint64_t max_particles = 4'000'000;

/// Of the faces of an OBJ file, all together: a closed mesh of triangles with that many vertices has 24 million.
inline constexpr std::uint64_t max_file_corners = 8 * max_particles;

/// m, of the tolerance and the sides of cells that a scene gives.
inline constexpr double least_length = 1e-9, most_length = 1e6;

/// Of a scene: m, of the tolerance, and m/s^2, of gravity along each axis. With more, steps of light bodies would not
/// stay finite.
inline constexpr double most_tolerance = 10, most_gravity = 1e3;

/// m, of a body's mesh. Smaller ones have areas and volumes that floats cannot hold in products, and weigh next to
/// nothing against the gas in them: their substeps could not be counted. The air around larger ones gives them energies
/// in which floats lose everything else.
inline constexpr double least_body_size = 1e-3, most_body_size = 1e4;

}  // namespace softbody
