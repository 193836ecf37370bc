#include "app/render/capture.h"

#include "app/render/scene_view.h"
#include "engine/gl.h"
#include "engine/headless.h"
#include "engine/resources.h"

namespace app::render {

struct Capture::Offscreen {
  engine::HeadlessContext context;  // first: the others need it
  engine::Framebuffer target;
  SceneView view;
};

Capture::Capture(int width, int height)
    : offscreen_(new Offscreen{.context = {},
                               .target = engine::Framebuffer({width, height}, 4),
                               .view = SceneView(engine::find_folder("shaders"))}) {}

Capture::~Capture() = default;

engine::Image Capture::draw(const softbody::BodiesInMotion& world) {
  const glm::ivec2 size = offscreen_->target.size();
  offscreen_->target.bind();
  offscreen_->view.draw(world, {}, offscreen_->view.camera(world, size), {{0, 0}, size}, 1.0f,
                        compare::DrawnMeshes(world));
  return offscreen_->target.read();
}

}  // namespace app::render
