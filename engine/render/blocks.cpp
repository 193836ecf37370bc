#include "engine/render/blocks.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "engine/render/frame_block.h"

namespace engine {
namespace {

constexpr GLsizei face_vertices = 6, cube_vertices = 36;
constexpr float patch = 1.5f;  // half the side of a plane's patch, in radii of the scene

struct Corner {
  glm::vec3 place, normal;
};

/// The faces of the cube from -1 to 1, counter-clockwise from outside; the first is y = 1.
std::vector<Corner> cube() {
  std::vector<Corner> corners;
  for (const int axis : {1, 2, 0}) {
    for (const float side : {1.0f, -1.0f}) {
      const auto at = [&](float u, float v) {
        glm::vec3 place, normal(0.0f);
        normal[axis] = place[axis] = side;
        place[(axis + 1) % 3] = u;
        place[(axis + 2) % 3] = side * v;
        return Corner{place, normal};
      };
      for (const Corner& c : {at(-1, -1), at(1, -1), at(1, 1), at(-1, -1), at(1, 1), at(-1, 1)}) corners.push_back(c);
    }
  }
  return corners;
}

/// Two directions across a unit vector, so that x, n, z are right-handed.
glm::mat3 frame_round(const glm::vec3& n) {
  const glm::vec3 least = std::abs(n.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
  const glm::vec3 z = glm::normalize(glm::cross(least, n));
  return {glm::cross(n, z), n, z};
}

}  // namespace

Blocks::Blocks(const std::filesystem::path& shaders)
    : block_(scene_program(shaders, "block.vert", "surface.frag")),
      block_shadow_(shaders, "block_shadow.vert", "depth.frag"),
      plane_(scene_program(shaders, "plane.vert", "plane.frag")) {
  array_.bind();
  const std::vector<Corner> corners = cube();
  corners_.set(GL_ARRAY_BUFFER, std::span(corners));
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Corner), attribute_offset(offsetof(Corner, place)));
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Corner), attribute_offset(offsetof(Corner, normal)));
  for (GLuint attribute = 0; attribute < 7; ++attribute) {
    glEnableVertexAttribArray(attribute);
    if (attribute >= 2) glVertexAttribDivisor(attribute, 1);
  }
}

void Blocks::update(const FrameData& frame) {
  instances_.clear();
  for (const Block& b : frame.blocks) instances_.push_back({b.centre, b.half_axes, b.colour});
  blocks_ = instances_.size();
  for (const Plane& p : frame.planes) {
    const glm::vec3 foot = frame.bounds_centre - glm::dot(frame.bounds_centre - p.point, p.normal) * p.normal;
    glm::mat3 axes = frame_round(p.normal);
    for (const int across : {0, 2}) axes[across] *= patch * frame.bounds_radius;
    instances_.push_back({foot - p.normal, axes, {}});  // the cube's face lies 1 m above its centre
  }
  if (!instances_.empty()) instance_buffer_.stream(GL_ARRAY_BUFFER, std::span<const Instance>(instances_));
}

void Blocks::draw_shadows(const glm::mat4& light_clip) const {
  if (blocks_ == 0) return;
  block_shadow_.use();
  block_shadow_.set("light_clip", light_clip);
  draw_instances(0, blocks_, cube_vertices);
}

void Blocks::draw() const {
  if (blocks_ > 0) {
    block_.use();
    draw_instances(0, blocks_, cube_vertices);
  }
  if (instances_.size() > blocks_) {
    plane_.use();
    draw_instances(blocks_, instances_.size() - blocks_, face_vertices);
  }
}

void Blocks::draw_instances(std::size_t first, std::size_t count, GLsizei vertices) const {
  array_.bind();
  glBindBuffer(GL_ARRAY_BUFFER, instance_buffer_.id());
  constexpr GLsizei stride = sizeof(Instance);
  const std::size_t start = first * sizeof(Instance);
  glVertexAttribPointer(2, 3, GL_FLOAT, GL_FALSE, stride, attribute_offset(start + offsetof(Instance, centre)));
  for (GLuint axis = 0; axis < 3; ++axis) {
    const std::size_t column = offsetof(Instance, half_axes) + axis * sizeof(glm::vec3);
    glVertexAttribPointer(3 + axis, 3, GL_FLOAT, GL_FALSE, stride, attribute_offset(start + column));
  }
  glVertexAttribPointer(6, 3, GL_FLOAT, GL_FALSE, stride, attribute_offset(start + offsetof(Instance, colour)));
  glEnable(GL_CULL_FACE);
  glDrawArraysInstanced(GL_TRIANGLES, 0, vertices, static_cast<GLsizei>(count));
  glDisable(GL_CULL_FACE);
}

}  // namespace engine
