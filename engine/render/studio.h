#pragma once
// The floor and the backdrop.

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "engine/frame_data.h"
#include "engine/gl.h"
#include "engine/render/floor_cells.h"

namespace engine {

class Studio {
 public:
  explicit Studio(const std::filesystem::path& shaders);

  /// Takes the spheres that darken the floor, with shadows that reach `soft` m beyond them.
  void update(const FrameData& frame, std::span<const glm::vec4> spheres, const glm::vec3& to_light, float soft);
  /// Draws where nothing has been drawn yet.
  void draw(bool with_floor) const;

 private:
  void draw_floor() const;

  Program open_, shaded_, shadowed_, backdrop_;
  VertexArray empty_, array_;
  Buffer buffer_;
  FloorCells cells_;
  std::vector<glm::vec2> corners_;  // x, z of triangles: all of the floor, what is shaded, what has shadows
};

}  // namespace engine
