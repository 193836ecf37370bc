#include "engine/frame_data.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <glm/geometric.hpp>

namespace engine {

void smooth_normals(std::span<const std::uint32_t> triangles, std::span<const glm::vec3> positions,
                    std::span<glm::vec3> normals) {
  assert(positions.size() == normals.size() && triangles.size() % 3 == 0);
  std::fill(normals.begin(), normals.end(), glm::vec3(0.0f));
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const std::uint32_t a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
    // The length of the cross product is twice the area, so large triangles count more.
    const glm::vec3 normal = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
    normals[a] += normal;
    normals[b] += normal;
    normals[c] += normal;
  }
  for (glm::vec3& normal : normals) {
    const float length = glm::length(normal);
    normal = length > 0.0f ? normal / length : glm::vec3(0.0f, 1.0f, 0.0f);
  }
}

}  // namespace engine
