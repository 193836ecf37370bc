#include "engine/render/floor_regions.h"

#include <cassert>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <limits>

namespace engine::render {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr FloorRect nowhere{glm::vec2(infinity), glm::vec2(-infinity)};

FloorRect united(const FloorRect& a, const FloorRect& b) { return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)}; }

FloorRect clipped(const FloorRect& rect, const FloorRegions::Floor& floor) {
  return {glm::max(rect.lo, floor.centre - floor.half_size), glm::min(rect.hi, floor.centre + floor.half_size)};
}

}  // namespace

void FloorRegions::update(std::span<const glm::vec4> spheres, const Floor& floor, const glm::vec3& to_light,
                          float softness) {
  assert(to_light.y > 0.0f);
  shadows_.clear();
  occluded_ = shadowed_ = nowhere;
  const glm::vec2 slant = glm::vec2(to_light.x, to_light.z) / to_light.y;
  const glm::vec2 stretch = glm::sqrt(1.0f + slant * slant);
  for (const glm::vec4& sphere : spheres) {
    const float height = sphere.y - floor.height;
    if (height + sphere.w < 0.0f) continue;
    const glm::vec2 foot(sphere.x, sphere.z), shadow = foot - slant * height;
    const glm::vec2 half = sphere.w * stretch + softness;
    if (const FloorRect visible = clipped({shadow - half, shadow + half}, floor); !visible.empty()) {
      shadows_.push_back(visible);
      shadowed_ = united(shadowed_, visible);
    }
    if (height > occlusion_height * sphere.w) continue;
    occluded_ = united(occluded_, {foot - occlusion_radius * sphere.w, foot + occlusion_radius * sphere.w});
  }
  occluded_ = clipped(occluded_, floor);
  cells_.fill(false);
  for (const FloorRect& rect : shadows_) mark_cells(rect);
}

void FloorRegions::mark_cells(const FloorRect& rect) {
  const glm::vec2 scale = static_cast<float>(cells_per_side) / (shadowed_.hi - shadowed_.lo);
  const auto cell = [&](const glm::vec2& at) {
    return glm::clamp(glm::ivec2((at - shadowed_.lo) * scale), glm::ivec2(0), glm::ivec2(cells_per_side - 1));
  };
  const glm::ivec2 first = cell(rect.lo), last = cell(rect.hi);
  for (int row = first.y; row <= last.y; ++row) {
    for (int column = first.x; column <= last.x; ++column) cells_[index(column, row)] = true;
  }
}

std::size_t FloorRegions::index(int column, int row) {
  assert(column >= 0 && column < cells_per_side && row >= 0 && row < cells_per_side);
  return static_cast<std::size_t>(row * cells_per_side + column);
}

}  // namespace engine::render
