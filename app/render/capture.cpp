#include "app/render/capture.h"

#include "app/files/output_file.h"
#include "app/render/scene_view.h"
#include "engine/gl.h"
#include "engine/headless.h"
#include "engine/resources.h"

namespace app {

struct Capture::Studio {
  engine::HeadlessContext context;  // first: the others need it
  engine::Framebuffer target;
  SceneView view;
};

Capture::Capture(int width, int height)
    : studio_(new Studio{.context = {},
                         .target = engine::Framebuffer({width, height}, 4),
                         .view = SceneView(engine::find_folder("shaders"))}) {}

Capture::~Capture() = default;

void Capture::write(const softbody::World& world, const std::filesystem::path& file) {
  const glm::ivec2 size = studio_->target.size();
  studio_->target.bind();
  studio_->view.draw(world, {}, studio_->view.camera(world.scene(), size), {{0, 0}, size}, 1.0f);
  write_file(file, engine::encode_png(studio_->target.read()));
}

}  // namespace app
