#include "app/render/canvas.h"

#include <array>
#include <cassert>
#include <utility>

#include <glm/common.hpp>

namespace app::render {
namespace {

// The next finer level takes at most 1.57 times as long to draw: a level that is fast enough to become finer does not
// become too slow by it.
constexpr std::array levels{1.0f, 0.8f, 0.65f, 0.55f};
constexpr double growth = 0.6, wanted = 1.0 / 30, too_slow = 1.0 / 29.5;  // s; a screen of 60 Hz can show 30 a second
constexpr int pictures_per_check = 36;

GLuint id_of(const engine::Framebuffer& framebuffer) {
  framebuffer.bind();
  GLint id = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &id);
  return static_cast<GLuint>(id);
}

void copy(const engine::Framebuffer& from, GLuint to, glm::ivec2 size, glm::ivec2 origin) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, id_of(from));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glBlitFramebuffer(0, 0, from.size().x, from.size().y, origin.x, origin.y, origin.x + size.x, origin.y + size.y,
                    GL_COLOR_BUFFER_BIT, from.size() == size ? GL_NEAREST : GL_LINEAR);
}

}  // namespace

float RenderScale::value() const { return levels[level_]; }

void RenderScale::add(double interval, double drawing) {
  interval_ += interval;
  drawing_ += drawing;
  if (++pictures_ < pictures_per_check) return;
  const double mean = std::exchange(interval_, 0) / pictures_per_check,
               mean_drawing = std::exchange(drawing_, 0) / pictures_per_check;
  pictures_ = 0;
  if (mean > too_slow && mean_drawing > 0.5 * mean && level_ + 1 < levels.size()) ++level_;
  if (mean + growth * mean_drawing < wanted && level_ > 0) --level_;
}

const engine::Framebuffer& Canvas::coarse(glm::ivec2 size) {
  drawn_at_ = render_scale_.value();
  const glm::ivec2 coarse_size = glm::max(glm::ivec2(drawn_at_ * glm::vec2(size)), 1);
  if (!coarse_ || coarse_->size() != coarse_size) coarse_.emplace(coarse_size, 0);
  return *coarse_;
}

void Canvas::update(glm::ivec2 size, bool changed, bool fine, const Draw& draw) {
  if (!full_ || full_->size() != size) {
    full_.emplace(size, 0);
    multisampled_.emplace(size, samples);
    changed = true;
  }
  moved_ = changed;
  if (!changed && (is_fine_ || !fine)) return;
  is_fine_ = fine || !in_software_;
  is_coarse_ = !is_fine_ && render_scale_.value() < 1;
  const engine::Framebuffer& target = is_fine_ ? *multisampled_ : is_coarse_ ? coarse(size) : *full_;
  target.bind();
  draw({{0, 0}, target.size()});
  if (is_fine_) copy(*multisampled_, id_of(*full_), size, {0, 0});
  glFlush();  // lets the driver begin while the program continues
}

void Canvas::show(glm::ivec2 origin) const {
  assert(full_);
  copy(is_coarse_ ? *coarse_ : *full_, 0, full_->size(), origin);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Canvas::add_timing(double interval, double drawing) {
  if (moved_ && !is_fine_) render_scale_.add(interval, drawing);
}

}  // namespace app::render
