#include "engine/gl.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <stdexcept>
#include <string>

namespace engine {
namespace {

int supported_samples(int wanted) {
  GLint max = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &max);
  return wanted < 2 ? 0 : std::min(wanted, max);
}

}  // namespace

void Buffer::upload(GLenum target, const void* data, std::size_t bytes, GLenum usage) {
  glBindBuffer(target, id());
  glBufferData(target, static_cast<GLsizeiptr>(bytes), data, usage);
}

void set_attributes(const Buffer& buffer, std::size_t stride, std::initializer_list<Attribute> attributes, GLuint first,
                    Advance advance) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
  for (GLuint index = first; const Attribute& a : attributes) {
    const auto size = static_cast<GLsizei>(stride);
    const auto* offset = reinterpret_cast<const void*>(a.offset);
    if (a.integers) {
      glVertexAttribIPointer(index, a.components, GL_UNSIGNED_INT, size, offset);
    } else {
      glVertexAttribPointer(index, a.components, GL_FLOAT, GL_FALSE, size, offset);
    }
    glVertexAttribDivisor(index, static_cast<GLuint>(advance));
    glEnableVertexAttribArray(index++);
  }
}

void Texture::bind(int unit, GLenum target) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(target, id());
}

void TableTexture::upload(int unit, const float* values, std::size_t count, std::size_t components) {
  struct Format {
    GLint stored;
    GLenum given;
  };
  constexpr std::array<Format, 4> formats{
      {{GL_R32F, GL_RED}, {GL_RG32F, GL_RG}, {GL_RGB32F, GL_RGB}, {GL_RGBA32F, GL_RGBA}}};
  assert(components >= 1 && components <= formats.size());
  const auto [stored, given] = formats[components - 1];
  constexpr std::size_t width = 2048;  // as in shaders/table.glsl; every driver supports it
  const std::size_t full_rows = count / width;
  texture_.bind(unit, GL_TEXTURE_2D);
  if (full_rows >= rows_) {
    rows_ = full_rows + 1;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);  // software renderers then read it faster
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, stored, width, static_cast<GLsizei>(rows_), 0, given, GL_FLOAT, nullptr);
  }
  const auto replace = [&, given = given](std::size_t row, std::size_t columns, std::size_t rows) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, static_cast<GLint>(row), static_cast<GLsizei>(columns),
                    static_cast<GLsizei>(rows), given, GL_FLOAT, values + row * width * components);
  };
  replace(0, width, full_rows);
  replace(full_rows, count % width, 1);
}

void set_linear_clamped() {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

Framebuffer::Framebuffer(glm::ivec2 size, int samples)
    : size_(size),
      samples_(supported_samples(samples)),
      framebuffer_(generated(glGenFramebuffers)),
      resolved_(samples_ > 0 ? generated(glGenFramebuffers) : 0),
      colour_(generated(glGenRenderbuffers)),
      depth_(generated(glGenRenderbuffers)),
      resolved_colour_(samples_ > 0 ? generated(glGenRenderbuffers) : 0) {
  GLint max = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &max);
  if (size.x < 1 || size.y < 1 || size.x > max || size.y > max) {
    throw std::runtime_error("a picture of " + std::to_string(size.x) + "x" + std::to_string(size.y) +
                             " pixels is not possible: 1x1 to " + std::to_string(max) + "x" + std::to_string(max) +
                             " is");
  }
  if (samples_ > 0) attach(resolved_.get(), resolved_colour_.get(), 0, 0);
  attach(framebuffer_.get(), colour_.get(), depth_.get(), samples_);
  bind();
}

void Framebuffer::attach(GLuint framebuffer, GLuint colour, GLuint depth, int samples) const {
  const auto add = [&](GLuint buffer, GLenum format, GLenum attachment) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, size_.x, size_.y);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  };
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  add(colour, GL_RGBA8, GL_COLOR_ATTACHMENT0);
  if (depth != 0) add(depth, GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error("the graphics driver refuses a picture of " + std::to_string(size_.x) + "x" +
                             std::to_string(size_.y) + " pixels: try a smaller one");
  }
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glViewport(0, 0, size_.x, size_.y);
}

Image Framebuffer::read() const {
  if (samples_ > 0) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.get());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.get());
    glBlitFramebuffer(0, 0, size_.x, size_.y, 0, 0, size_.x, size_.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  Image image = read_pixels(samples_ > 0 ? resolved_.get() : framebuffer_.get(), size_);
  bind();
  return image;
}

Image read_pixels(GLuint framebuffer, glm::ivec2 size) {
  const auto row = 4 * static_cast<std::size_t>(size.x);
  Image image{size.x, size.y, std::vector<std::uint8_t>(row * static_cast<std::size_t>(size.y))};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  // OpenGL returns the bottom row first.
  const auto begin = image.rgba.begin();
  for (std::size_t top = 0, bottom = image.rgba.size(); top + row < bottom; top += row) {
    bottom -= row;
    std::swap_ranges(begin + static_cast<std::ptrdiff_t>(top), begin + static_cast<std::ptrdiff_t>(top + row),
                     begin + static_cast<std::ptrdiff_t>(bottom));
  }
  return image;
}

}  // namespace engine
