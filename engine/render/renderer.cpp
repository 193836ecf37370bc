#include "engine/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/context.h"
#include "engine/gl.h"
#include "engine/render/ambient_occlusion.h"
#include "engine/render/body_pass.h"
#include "engine/render/box_pass.h"
#include "engine/render/environment_pass.h"
#include "engine/render/floor_map.h"
#include "engine/render/frame_uniforms.h"
#include "engine/render/overlay_pass.h"
#include "engine/render/shadow_map.h"
#include "engine/render/sphere_pass.h"

namespace engine::render {
namespace {

constexpr float floor_map_half_size = 1.5f;  // in radii of the scene

/// Returns the distance of grid lines in m: a power of ten that divides the scene into a handful of cells.
float grid_spacing(float scene_radius) { return std::pow(10.0f, std::floor(std::log10(0.6f * scene_radius))); }

}  // namespace

struct Renderer::Passes {
  explicit Passes(const std::filesystem::path& shaders)
      : bodies(shaders),
        spheres(shaders),
        boxes(shaders),
        floor_map(shaders),
        environment(shaders),
        overlays(shaders) {}

  void find_casters(const FrameData& frame) {
    casters.clear();
    for (std::size_t i = 0; i < frame.meshes.size(); ++i) {
      const glm::vec4& sphere = occlusion.spheres()[i];
      const bool finite = sphere.w > 0;
      if (finite) casters.emplace_back(glm::vec3(sphere), occlusion.reaches()[i]);
    }
    for (const Sphere& s : frame.spheres) casters.emplace_back(s.centre, s.radius);
    for (const Capsule& c : frame.capsules)
      casters.emplace_back(0.5f * (c.from + c.to), 0.5f * glm::distance(c.from, c.to) + c.radius);
    for (const OrientedBox& b : frame.oriented_boxes) {
      const glm::mat3& a = b.half_axes;
      casters.emplace_back(b.centre, std::sqrt(glm::dot(a[0], a[0]) + glm::dot(a[1], a[1]) + glm::dot(a[2], a[2])));
    }
  }

  FrameUniforms frame_uniforms(const Camera& camera, const Viewport& viewport, const FrameData& frame) const {
    const glm::vec3& centre = frame.bounds_centre;
    const float radius = frame.bounds_radius;
    FrameUniforms values{};
    values.clip_from_world = camera.projection(viewport.size) * camera.view();
    values.shadow_from_world = light.texture_from_world();
    values.eye = glm::vec4(camera.eye(), frame.pixel_scale);
    values.to_light = glm::vec4(to_light, light.texel_size);
    values.viewport = glm::vec4(viewport.origin, viewport.size);
    values.floor_map =
        glm::vec4(centre.x, centre.z, 0.5f / (floor_map_half_size * radius), frame.floor_height.value_or(0.0f));
    values.scene = glm::vec4(centre.x, centre.z, radius, grid_spacing(radius));
    values.shadow_bounds = light.shadow_bounds(casters);
    values.flags.x = frame.floor_height ? 1.0f : 0.0f;
    return values;
  }

  void update(const Camera& camera, const Viewport& viewport, const FrameData& frame) {
    light = shadow_map.light_view(to_light, frame.bounds_centre, frame.bounds_radius);
    occlusion.update(frame);
    find_casters(frame);
    const FrameUniforms values = frame_uniforms(camera, viewport, frame);
    uniform_buffer.stream(GL_UNIFORM_BUFFER, std::span(&values, 1));
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniform_buffer.id());
    const float pixels_at_one_metre = 0.5f * static_cast<float>(viewport.size.y) / std::tan(0.5f * camera.fov);
    bodies.update(frame, occlusion, camera.eye(), pixels_at_one_metre);
    spheres.update(frame, occlusion);
    boxes.update(frame);
    environment.update(frame, casters, to_light, 8.0f * light.texel_size);
  }

  void draw_shadows() {
    shadow_map.begin();
    bodies.draw_shadows(light.clip_from_world);
    spheres.draw_shadows(light.clip_from_world);
    boxes.draw_shadows(light.clip_from_world);
    shadow_map.end();
  }

  void draw_scene(const Viewport& viewport, const FrameData& frame) {
    glViewport(viewport.origin.x, viewport.origin.y, viewport.size.x, viewport.size.y);
    glScissor(viewport.origin.x, viewport.origin.y, viewport.size.x, viewport.size.y);
    glEnable(GL_SCISSOR_TEST);
    glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
    shadow_map.texture().bind(unit_shadow_map, GL_TEXTURE_2D);
    if (std::ranges::any_of(frame.translucent, &TranslucentSet::behind_bodies)) glEnable(GL_STENCIL_TEST);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glStencilFunc(GL_ALWAYS, stencil_bodies, stencil_bodies);
    bodies.draw(frame);
    glStencilFunc(GL_ALWAYS, 0, stencil_bodies);
    spheres.draw();
    boxes.draw();
    glDisable(GL_STENCIL_TEST);
    environment.draw(frame.floor_height.has_value());
    if (software_renderer) glFlush();  // so that the driver's threads draw while this one prepares the overlays
    bodies.draw_translucent(true);
    overlays.draw(frame);
    bodies.draw_translucent(false);
  }

  const bool software_renderer = uses_software_renderer();
  glm::vec3 to_light = glm::normalize(glm::vec3(-0.40f, 1.0f, 0.42f));
  LightView light{};
  AmbientOcclusion occlusion;
  std::vector<glm::vec4> casters;  // spheres round all that casts shadows: centre, radius
  ShadowMap shadow_map;
  BodyPass bodies;
  SpherePass spheres;
  BoxPass boxes;
  FloorMap floor_map;
  EnvironmentPass environment;
  OverlayPass overlays;
  Buffer uniform_buffer;
};

Renderer::Renderer(const std::filesystem::path& shaders) : passes_(std::make_unique<Passes>(shaders)) {}
Renderer::~Renderer() = default;

MeshHandle Renderer::add_mesh(std::span<const std::uint32_t> triangles, std::uint32_t vertex_count) {
  return passes_->bodies.add_mesh(triangles, vertex_count);
}

void Renderer::draw(const Camera& camera, const Viewport& viewport, const FrameData& frame) {
  if (viewport.size.x <= 0 || viewport.size.y <= 0) return;
  passes_->bodies.check(frame);
  GLint drawn_to = 0, read_from = 0;  // the framebuffers that are bound
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawn_to);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_from);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  passes_->update(camera, viewport, frame);
  passes_->draw_shadows();
  if (frame.floor_height) passes_->floor_map.draw(frame, passes_->occlusion);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(drawn_to));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_from));
  passes_->draw_scene(viewport, frame);
  glDepthFunc(GL_LESS);
  glBindVertexArray(0);
}

}  // namespace engine::render
