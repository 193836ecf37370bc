#pragma once
// Finds the parts of the floor that are darkened, so that the costly shaders run only there. No OpenGL.

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace engine::render {

// A sphere hides part of the sky from the floor up to this distance from the point below its centre, if the centre is
// no higher than this. In radii; the radius equals that in floor_map.vert.
constexpr float occlusion_radius = 4.0f, occlusion_height = 8.0f;

/// An axis-aligned rectangle on the floor, in m.
struct FloorRect {
  glm::vec2 lo, hi;  // x, z
  bool empty() const { return !(lo.x < hi.x && lo.y < hi.y); }
};

/// The rectangle with ambient occlusion, and a grid of square cells that marks where shadows may fall.
class FloorRegions {
 public:
  static constexpr int cells_per_side = 80;
  struct Floor {
    glm::vec2 centre;  // x, z
    float half_size;   // m: all regions are clipped to this square
    float height;      // m
  };

  /// Each of `spheres` (centre, radius) casts a shadow that is `softness` m larger than the sphere. `to_light` points
  /// upwards.
  void update(std::span<const glm::vec4> spheres, const Floor& floor, const glm::vec3& to_light, float softness);

  const FloorRect& occluded() const { return occluded_; }
  const FloorRect& shadowed() const { return shadowed_; }  // the whole grid
  /// True if a shadow may fall into the cell. `column` and `row` count from the grid's lo corner, < cells_per_side.
  bool is_shadowed(int column, int row) const { return cells_[index(column, row)]; }

 private:
  static std::size_t index(int column, int row);
  void mark_cells(const FloorRect& rect);

  std::vector<FloorRect> shadows_;
  std::array<bool, cells_per_side * cells_per_side> cells_{};
  FloorRect occluded_{}, shadowed_{};
};

}  // namespace engine::render
