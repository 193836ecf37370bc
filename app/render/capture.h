#pragma once
// Draws pictures of a world without a window.

#include "app/render/halves.h"
#include "app/render/scene_view.h"
#include "engine/gl.h"
#include "engine/headless.h"
#include "engine/resources.h"

namespace app::render {

class Capture {
 public:
  /// Throws engine::ContextError, engine::ResourceError or engine::ShaderError with one line that says what is missing.
  explicit Capture(glm::ivec2 size) : target_(size, 4), view_(engine::find_folder("shaders")) {}

  /// Returns a picture of exactly that size, seen by the scene's own camera; of two worlds with the second one at the
  /// right.
  engine::Image draw(const softbody::BodiesInMotion& world, const softbody::BodiesInMotion* second = nullptr) {
    const engine::Viewport whole{{0, 0}, target_.size()};
    target_.bind();
    const auto halves = side_by_side(whole, 0.5f);
    draw(world, second ? halves[0] : whole);
    if (second) draw(*second, halves[1]);
    return target_.read();
  }

 private:
  void draw(const softbody::BodiesInMotion& world, const engine::Viewport& part) {
    view_.draw(world, {}, view_.camera(world, part.size), part, 1.0f, DrawnMeshes(world));
  }

  engine::HeadlessContext context_;  // first: the others need it
  engine::Framebuffer target_;
  SceneView view_;
};

}  // namespace app::render
