#pragma once
// Cutting the triangles of a mesh into smaller ones, by topology alone: positions come later. No OpenGL.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace engine {

/// A point inside a triangle: the corners' weights are weights[0], weights[1] and what is left to 1. A vertex of the
/// mesh has it three times; a point on an edge names the edge's ends alone, so that both triangles there agree to the
/// bit.
struct RefinedVertex {
  std::array<std::uint32_t, 3> corners;
  std::array<float, 2> weights;
};

struct RefinedMesh {
  std::vector<RefinedVertex> vertices;  // first those of the mesh
  std::vector<std::uint32_t> indices;
};

/// Cuts every edge into `cuts` >= 1 parts, and so every triangle into cuts * cuts.
RefinedMesh refine(std::span<const std::uint32_t> triangles, std::uint32_t vertex_count, int cuts);

/// True if every edge has one triangle on either side.
bool is_closed(std::span<const std::uint32_t> triangles);

}  // namespace engine
