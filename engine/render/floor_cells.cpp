#include "engine/render/floor_cells.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <limits>

namespace engine {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr FloorArea nowhere{glm::vec2(infinity), glm::vec2(-infinity)};

FloorArea together(const FloorArea& a, const FloorArea& b) { return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)}; }

FloorArea within(const FloorArea& area, const FloorCells::Place& floor) {
  return {glm::max(area.lo, floor.centre - floor.reach), glm::min(area.hi, floor.centre + floor.reach)};
}

}  // namespace

void FloorCells::update(std::span<const glm::vec4> spheres, const Place& floor, const glm::vec3& to_light, float soft) {
  shadows_.clear();
  shaded_ = shadowed_ = nowhere;
  const glm::vec2 slant = glm::vec2(to_light.x, to_light.z) / to_light.y;
  const glm::vec2 stretch = glm::sqrt(1.0f + slant * slant);
  for (const glm::vec4& sphere : spheres) {
    const float height = sphere.y - floor.height;
    if (height + sphere.w < 0.0f) continue;
    const glm::vec2 foot(sphere.x, sphere.z), shadow = foot - slant * height;
    const glm::vec2 half = sphere.w * stretch + soft;
    add_shadow({shadow - half, shadow + half}, floor);
    if (height > sky_height * sphere.w) continue;
    shaded_ = together(shaded_, {foot - sky_reach * sphere.w, foot + sky_reach * sphere.w});
  }
  shaded_ = within(shaded_, floor);
  cells_.fill(false);
  for (const FloorArea& area : shadows_) mark(area);
}

void FloorCells::add_shadow(const FloorArea& area, const Place& floor) {
  const FloorArea seen = within(area, floor);
  if (seen.empty()) return;
  shadows_.push_back(seen);
  shadowed_ = together(shadowed_, seen);
}

void FloorCells::mark(const FloorArea& area) {
  const glm::vec2 scale = static_cast<float>(side) / (shadowed_.hi - shadowed_.lo);
  const auto index = [&](const glm::vec2& at) {
    return glm::clamp(glm::ivec2((at - shadowed_.lo) * scale), glm::ivec2(0), glm::ivec2(side - 1));
  };
  const glm::ivec2 first = index(area.lo), last = index(area.hi);
  for (int row = first.y; row <= last.y; ++row) {
    for (int column = first.x; column <= last.x; ++column) cells_[static_cast<std::size_t>(row * side + column)] = true;
  }
}

}  // namespace engine
