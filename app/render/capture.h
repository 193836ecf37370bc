#pragma once
// Draws pictures of a world without a window.

#include "app/render/scene_view.h"
#include "engine/gl.h"
#include "engine/headless.h"
#include "engine/resources.h"

namespace app::render {

class Capture {
 public:
  /// Throws engine::ContextError, engine::ResourceError or engine::ShaderError with one line that says what is missing.
  explicit Capture(glm::ivec2 size) : target_(size, 4), view_(engine::find_folder("shaders")) {}

  /// Returns a picture of exactly that size, seen by the scene's own camera.
  engine::Image draw(const softbody::BodiesInMotion& world) {
    const glm::ivec2 size = target_.size();
    target_.bind();
    view_.draw(world, {}, view_.camera(world, size), {{0, 0}, size}, 1.0f, DrawnMeshes(world));
    return target_.read();
  }

 private:
  engine::HeadlessContext context_;  // first: the others need it
  engine::Framebuffer target_;
  SceneView view_;
};

}  // namespace app::render
