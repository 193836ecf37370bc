#include "app/demo/canvas.h"

namespace app {
namespace {

GLuint id_of(const engine::Framebuffer& framebuffer) {
  framebuffer.bind();
  GLint id = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &id);
  return static_cast<GLuint>(id);
}

void copy(GLuint from, GLuint to, glm::ivec2 size, glm::ivec2 origin) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glBlitFramebuffer(0, 0, size.x, size.y, origin.x, origin.y, origin.x + size.x, origin.y + size.y, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
}

}  // namespace

void Canvas::update(glm::ivec2 size, bool changed, bool still,
                    const std::function<void(const engine::Viewport&)>& draw) {
  if (!plain_ || plain_->size() != size) {
    plain_.emplace(size, 0);
    multisampled_.emplace(size, samples);
    changed = true;
  }
  const bool refine = still && !changed && !is_smooth_;
  if (!changed && !refine) return;
  is_smooth_ = smooth_motion_ || refine;
  (is_smooth_ ? *multisampled_ : *plain_).bind();
  draw({{0, 0}, size});
  if (is_smooth_) copy(id_of(*multisampled_), id_of(*plain_), size, {0, 0});
}

void Canvas::show(glm::ivec2 origin) const {
  copy(id_of(*plain_), 0, plain_->size(), origin);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace app
