#pragma once
// Where on the floor something is to be seen: what costs most to shade is drawn there alone. No OpenGL.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace engine {

// A sphere darkens the floor as far round its foot as this, and up to this height, in its radii (floor_map.frag).
constexpr float sky_reach = 4.0f, sky_height = 8.0f;

struct FloorArea {
  glm::vec2 lo, hi;  // x, z
  bool empty() const { return !(lo.x < hi.x && lo.y < hi.y); }
};

/// Where spheres hide part of the sky from the floor, and cells for where they cast shadows on it.
class FloorCells {
 public:
  static constexpr int side = 80;
  struct Place {
    glm::vec2 centre;  // x, z; cells lie at most `reach` m away from it
    float reach;
    float height;
  };

  /// Takes shadows to reach `soft` m beyond those of the spheres.
  void update(std::span<const glm::vec4> spheres, const Place& floor, const glm::vec3& to_light, float soft);

  const FloorArea& shaded() const { return shaded_; }
  const FloorArea& shadowed() const { return shadowed_; }  // all cells
  bool shadowed(int column, int row) const { return cells_[static_cast<std::size_t>(row * side + column)]; }

 private:
  void add_shadow(const FloorArea& area, const Place& floor);
  void mark(const FloorArea& area);

  std::vector<FloorArea> shadows_;
  std::array<bool, side * side> cells_{};
  FloorArea shaded_{}, shadowed_{};
};

}  // namespace engine
