#pragma once
// Cuts the triangles of a mesh into smaller ones, by topology alone: positions come later. No OpenGL.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace engine::render {

/// A point in a triangle, in barycentric coordinates: the third corner's weight is what is missing to 1. A vertex of
/// the mesh has three equal corners. A point on an edge names only the ends of the edge, so that both triangles at the
/// edge give it bit-equal coordinates. No other point has two equal first corners.
struct TessellatedVertex {
  std::array<std::uint32_t, 3> corners;
  std::array<float, 2> weights;  // of corners 0 and 1
};

struct TessellatedMesh {
  std::vector<TessellatedVertex> vertices;  // first those of the mesh
  std::vector<std::uint32_t> indices;       // three per triangle
};

/// Cuts every edge into `factor` >= 1 equal parts, and so every triangle into factor * factor. `triangles` holds three
/// indices < vertex_count per triangle.
TessellatedMesh tessellate(std::span<const std::uint32_t> triangles, std::uint32_t vertex_count, int factor);

/// True if every edge has exactly one triangle on each side. `triangles` holds three indices per triangle.
bool is_closed(std::span<const std::uint32_t> triangles);

}  // namespace engine::render
