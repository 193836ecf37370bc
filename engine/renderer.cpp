#include "engine/renderer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/context.h"
#include "engine/gl.h"
#include "engine/render/blocks.h"
#include "engine/render/bodies.h"
#include "engine/render/frame_block.h"
#include "engine/render/occlusion.h"
#include "engine/render/overlays.h"
#include "engine/render/shadow.h"
#include "engine/render/solids.h"
#include "engine/render/studio.h"

namespace engine {
namespace {

constexpr float floor_map_reach = 1.5f;  // half its width, in radii of the scene

/// A round distance that cuts the scene into a handful of squares.
float grid_spacing(float scene_radius) { return std::pow(10.0f, std::floor(std::log10(0.6f * scene_radius))); }

/// What draw() changes and must leave as it found it: the target and the part of it.
class SavedTarget {
 public:
  SavedTarget() {
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer_);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
  }
  void bind() const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(framebuffer_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_));
  }

 private:
  GLint framebuffer_ = 0, read_ = 0;
};

}  // namespace

struct Renderer::Passes {
  explicit Passes(const std::filesystem::path& shaders)
      : bodies(shaders), spheres(shaders), blocks(shaders), floor_map(shaders), studio(shaders), overlays(shaders) {}

  void update(const Camera& camera, const Viewport& viewport, const FrameData& frame);
  void draw_shadows();
  void draw_scene(const Viewport& viewport, const FrameData& frame);
  void find_casters(const FrameData& frame);
  FrameBlock describe(const Camera& camera, const Viewport& viewport, const FrameData& frame) const;

  const bool in_software = draws_in_software();
  glm::vec3 to_light = glm::normalize(glm::vec3(-0.40f, 1.0f, 0.42f));
  LightView light{};
  Occlusion occlusion;
  std::vector<glm::vec4> casters;  // spheres round all that casts shadows
  ShadowMap shadow_map;
  Bodies bodies;
  Spheres spheres;
  Blocks blocks;
  FloorMap floor_map;
  Studio studio;
  Overlays overlays;
  Buffer block;
};

void Renderer::Passes::find_casters(const FrameData& frame) {
  casters.clear();
  for (std::size_t i = 0; i < frame.meshes.size(); ++i) {
    const glm::vec3 centre(occlusion.spheres()[i]);
    const MeshDraw& draw = frame.meshes[i];
    const bool finite = occlusion.spheres()[i].w > 0;
    if (finite)
      casters.emplace_back(centre, reach(centre, frame.positions.subspan(draw.first_vertex, draw.vertex_count)));
  }
  for (const Sphere& s : frame.spheres) casters.emplace_back(s.centre, s.radius);
  for (const Capsule& c : frame.capsules)
    casters.emplace_back(0.5f * (c.from + c.to), 0.5f * glm::distance(c.from, c.to) + c.radius);
  for (const Block& b : frame.blocks) {
    const glm::mat3& a = b.half_axes;  // at right angles
    casters.emplace_back(b.centre, std::sqrt(glm::dot(a[0], a[0]) + glm::dot(a[1], a[1]) + glm::dot(a[2], a[2])));
  }
}

FrameBlock Renderer::Passes::describe(const Camera& camera, const Viewport& viewport, const FrameData& frame) const {
  const glm::vec3& centre = frame.bounds_centre;
  const float radius = frame.bounds_radius;
  FrameBlock values{};
  values.clip_from_world = camera.projection(viewport.size) * camera.view();
  values.shadow_from_world = light.texture_from_world();
  values.eye = glm::vec4(camera.eye(), frame.pixel_scale);
  values.to_light = glm::vec4(to_light, light.texel);
  values.viewport = glm::vec4(viewport.origin, viewport.size);
  values.floor_map = glm::vec4(centre.x, centre.z, 0.5f / (floor_map_reach * radius), frame.ground.value_or(0.0f));
  values.scene = glm::vec4(centre.x, centre.z, radius, grid_spacing(radius));
  values.casters = light.reach_of(casters);
  values.flags.x = frame.ground ? 1.0f : 0.0f;
  return values;
}

void Renderer::Passes::update(const Camera& camera, const Viewport& viewport, const FrameData& frame) {
  light = shadow_map.view(to_light, frame.bounds_centre, frame.bounds_radius);
  occlusion.update(frame);
  find_casters(frame);
  const FrameBlock values = describe(camera, viewport, frame);
  block.stream(GL_UNIFORM_BUFFER, std::span(&values, 1));
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, block.id());
  const float pixels_at_one_metre = 0.5f * static_cast<float>(viewport.size.y) / std::tan(0.5f * camera.fov);
  bodies.update(frame, occlusion, camera.eye(), pixels_at_one_metre);
  spheres.update(frame, occlusion);
  blocks.update(frame);
  studio.update(frame, casters, to_light, 8.0f * light.texel);
}

void Renderer::Passes::draw_shadows() {
  shadow_map.begin();
  bodies.draw_shadows(light.clip_from_world);
  spheres.draw_shadows(light.clip_from_world);
  blocks.draw_shadows(light.clip_from_world);
  shadow_map.end();
}

void Renderer::Passes::draw_scene(const Viewport& viewport, const FrameData& frame) {
  glViewport(viewport.origin.x, viewport.origin.y, viewport.size.x, viewport.size.y);
  glScissor(viewport.origin.x, viewport.origin.y, viewport.size.x, viewport.size.y);
  glEnable(GL_SCISSOR_TEST);
  glClear(GL_DEPTH_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
  shadow_map.texture().bind(unit_shadow_map, GL_TEXTURE_2D);
  bodies.draw();
  spheres.draw();
  blocks.draw();
  studio.draw(frame.ground.has_value());
  if (in_software) glFlush();  // so that other cores begin while this one gets the overlays ready
  bodies.draw_translucent();
  overlays.draw(frame);
}

Renderer::Renderer(const std::filesystem::path& shaders) : passes_(std::make_unique<Passes>(shaders)) {}
Renderer::~Renderer() = default;

MeshHandle Renderer::add_mesh(std::span<const std::uint32_t> triangles, std::uint32_t vertex_count) {
  return passes_->bodies.add_mesh(triangles, vertex_count);
}

void Renderer::draw(const Camera& camera, const Viewport& viewport, const FrameData& frame) {
  if (viewport.size.x <= 0 || viewport.size.y <= 0) return;
  passes_->bodies.check(frame);
  const SavedTarget target;
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  passes_->update(camera, viewport, frame);
  passes_->draw_shadows();
  if (frame.ground) passes_->floor_map.draw(frame, passes_->occlusion);
  target.bind();
  passes_->draw_scene(viewport, frame);
  glDepthFunc(GL_LESS);
  glBindVertexArray(0);
}

}  // namespace engine
