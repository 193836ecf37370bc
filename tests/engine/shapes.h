#pragma once
// Meshes for the tests.

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace engine {

struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> triangles;
};

/// Returns 12 vertices at distance 1 from the origin; the triangles are counter-clockwise from outside.
inline Mesh icosahedron() {
  constexpr float g = 1.618034f;
  Mesh mesh{{{-1, g, 0},
             {1, g, 0},
             {-1, -g, 0},
             {1, -g, 0},
             {0, -1, g},
             {0, 1, g},
             {0, -1, -g},
             {0, 1, -g},
             {g, 0, -1},
             {g, 0, 1},
             {-g, 0, -1},
             {-g, 0, 1}},
            {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4,  11, 10, 2,  10, 7, 6, 7, 1, 8,
             3, 9,  4, 3, 4, 2, 3, 2, 6, 3, 6, 8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6,  2,  10, 8,  6, 7, 9, 8, 1}};
  for (glm::vec3& position : mesh.positions) position = glm::normalize(position);
  return mesh;
}

}  // namespace engine
