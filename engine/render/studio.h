#pragma once
// The floor and the backdrop.

#include <cstdint>
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
  void draw_shadowed_cells() const;
  void draw_square(const Program& program, const FloorArea& area, float behind) const;

  Program open_, shaded_, shadowed_, backdrop_;
  VertexArray empty_, array_;
  Buffer indices_;
  FloorCells cells_;
  std::vector<std::uint16_t> corners_;  // of the triangles of the cells with shadows
  FloorCells::Place floor_{};
};

}  // namespace engine
