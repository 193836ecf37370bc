#pragma once
// OpenGL objects that delete themselves. They can be moved, not copied. Each needs its context to be current, also when
// it is destroyed.

#include <GL/glew.h>

#include <cstddef>
#include <glm/vec2.hpp>
#include <initializer_list>
#include <span>
#include <utility>

#include "engine/image.h"

namespace engine {

/// Owns one OpenGL object by its name; 0: none.
template <void (*destroy)(GLuint)>
class GlName {
 public:
  explicit GlName(GLuint name = 0) : name_(name) {}
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlName() {
    if (name_ != 0) destroy(name_);
  }
  GLuint get() const { return name_; }

 private:
  GLuint name_;
};

namespace detail {
inline void delete_buffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void delete_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void delete_texture(GLuint name) { glDeleteTextures(1, &name); }
inline void delete_shader(GLuint name) { glDeleteShader(name); }
inline void delete_program(GLuint name) { glDeleteProgram(name); }
inline void delete_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void delete_renderbuffer(GLuint name) { glDeleteRenderbuffers(1, &name); }
}  // namespace detail

/// Returns the name of a new object, by glGenBuffers() or the like.
template <class Generate>
GLuint generated(Generate generate) {
  GLuint name = 0;
  generate(1, &name);
  return name;
}

using FramebufferName = GlName<detail::delete_framebuffer>;

/// A buffer whose data is set once or streamed every frame.
class Buffer {
 public:
  GLuint id() const { return name_.get(); }

  /// Replaces the contents; for data that stays. Leaves the buffer bound to `target`.
  template <class T>
  void set(GLenum target, std::span<const T> data) {
    upload(target, data.data(), data.size_bytes(), GL_STATIC_DRAW);
  }
  /// Replaces the contents; for data of one frame. Never waits for the GPU, because the old storage is orphaned. Leaves
  /// the buffer bound to `target`.
  template <class T>
  void stream(GLenum target, std::span<const T> data) {
    upload(target, data.data(), data.size_bytes(), GL_STREAM_DRAW);
  }

 private:
  void upload(GLenum target, const void* data, std::size_t bytes, GLenum usage);

  GlName<detail::delete_buffer> name_{generated(glGenBuffers)};
};

class VertexArray {
 public:
  void bind() const { glBindVertexArray(name_.get()); }

 private:
  GlName<detail::delete_vertex_array> name_{generated(glGenVertexArrays)};
};

/// What a vertex shader reads from each row of a buffer.
struct Attribute {
  GLint components;    // 1 to 4 floats, or unsigned integers
  std::size_t offset;  // in the row, bytes
  bool integers = false;
};
enum class Advance : GLuint { per_vertex, per_instance };

/// Lets the bound vertex array read `attributes`, numbered from `first` on, from `buffer`, whose rows have `stride`
/// bytes.
void set_attributes(const Buffer& buffer, std::size_t stride, std::initializer_list<Attribute> attributes,
                    GLuint first = 0, Advance advance = Advance::per_instance);

/// A texture of any kind; the caller binds and defines it.
class Texture {
 public:
  GLuint id() const { return name_.get(); }
  void bind(int unit, GLenum target) const;

 private:
  GlName<detail::delete_texture> name_{generated(glGenTextures)};
};

/// Values that a shader reads by their numbers, with table_value() of shaders/table.glsl. They lie in the rows of a 2D
/// texture, because WebGL 2 has no buffer textures.
class TableTexture {
 public:
  /// Replaces the values, each of 1 to 4 floats. Leaves the texture bound to `unit`.
  template <class T>
  void stream(int unit, std::span<const T> values) {
    static_assert(sizeof(T) % sizeof(float) == 0);
    upload(unit, reinterpret_cast<const float*>(values.data()), values.size(), sizeof(T) / sizeof(float));
  }

 private:
  void upload(int unit, const float* values, std::size_t count, std::size_t components);

  Texture texture_;
  std::size_t rows_ = 0;
};

/// Filters the bound 2D texture linearly and repeats its outermost texels beyond its edges.
void set_linear_clamped();

/// An off-screen framebuffer: RGBA8 (sRGB values, stored unconverted) and 24-bit depth, optionally multisampled.
class Framebuffer {
 public:
  /// `samples` is reduced to what the driver supports; below 2: no multisampling. Leaves the framebuffer bound. Throws
  /// std::runtime_error if the driver does not support `size` (pixels, at least 1 x 1).
  explicit Framebuffer(glm::ivec2 size, int samples = 4);

  glm::ivec2 size() const { return size_; }
  void bind() const;   // also sets the viewport to the whole framebuffer
  Image read() const;  // resolves the samples; leaves this framebuffer bound

 private:
  void attach(GLuint framebuffer, GLuint colour, GLuint depth, int samples) const;

  glm::ivec2 size_;
  int samples_;  // 0: not multisampled
  FramebufferName framebuffer_, resolved_;
  GlName<detail::delete_renderbuffer> colour_, depth_, resolved_colour_;
};

/// Reads the colours of a framebuffer that is not multisampled. `framebuffer` 0: the window's back buffer.
Image read_pixels(GLuint framebuffer, glm::ivec2 size);

}  // namespace engine
