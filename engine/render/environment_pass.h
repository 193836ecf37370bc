#pragma once
// Draws the floor and the backdrop.

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "engine/frame_data.h"
#include "engine/gl.h"
#include "engine/program.h"
#include "engine/render/floor_regions.h"

namespace engine::render {

class EnvironmentPass {
 public:
  explicit EnvironmentPass(const std::filesystem::path& shaders);

  /// The arguments after `frame` are those of FloorRegions::update().
  void update(const FrameData& frame, std::span<const glm::vec4> casters, const glm::vec3& to_light, float softness);
  /// Draws after all solids, because it covers only what they leave free.
  void draw(bool with_floor) const;

 private:
  void draw_floor() const;

  Program lit_, occluded_, shadowed_, backdrop_;
  VertexArray empty_, array_;
  Buffer buffer_;
  FloorRegions regions_;
  std::vector<glm::vec2> vertices_;  // x, z of triangles: the whole floor, its occluded part, its shadowed cells
};

}  // namespace engine::render
