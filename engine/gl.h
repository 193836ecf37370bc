#pragma once
// OpenGL objects that delete themselves. All need a current context, also when destroyed. Move-only.

#include <GL/glew.h>

#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "engine/image.h"

namespace engine {

/// Owner of one OpenGL name.
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

/// Of a vertex's attribute in its buffer, as glVertexAttribPointer takes it.
inline const void* attribute_offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

namespace detail {
void delete_buffer(GLuint name);
void delete_vertex_array(GLuint name);
void delete_texture(GLuint name);
void delete_program(GLuint name);
void delete_framebuffer(GLuint name);
void delete_renderbuffer(GLuint name);
}  // namespace detail

/// A buffer for data that is either set once or streamed every frame.
class Buffer {
 public:
  Buffer();
  GLuint id() const { return name_.get(); }

  /// Replaces the contents for good. Leaves the buffer bound to `target`.
  template <class T>
  void set(GLenum target, std::span<const T> data) {
    upload(target, data.data(), data.size_bytes(), GL_STATIC_DRAW);
  }
  /// Replaces the contents for one frame; never waits for the GPU, as the old storage is orphaned.
  template <class T>
  void stream(GLenum target, std::span<const T> data) {
    upload(target, data.data(), data.size_bytes(), GL_STREAM_DRAW);
  }

 private:
  void upload(GLenum target, const void* data, std::size_t bytes, GLenum usage);

  GlName<detail::delete_buffer> name_;
};

class VertexArray {
 public:
  VertexArray();
  void bind() const { glBindVertexArray(name_.get()); }

 private:
  GlName<detail::delete_vertex_array> name_;
};

/// A texture of any kind; the caller binds and defines it.
class Texture {
 public:
  Texture();
  GLuint id() const { return name_.get(); }
  void bind(int unit, GLenum target) const;

 private:
  GlName<detail::delete_texture> name_;
};

/// A shader did not compile or link, or its file cannot be read. what() begins with "file:line: " where the driver
/// says.
class ShaderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A vertex and a fragment shader, read from `folder`. A line `#include "name"` inserts a file of the same folder. Its
/// uniform block "Frame" reads binding 0.
class Program {
 public:
  /// Throws ShaderError.
  Program(const std::filesystem::path& folder, const std::string& vertex_file, const std::string& fragment_file);

  void use() const { glUseProgram(name_.get()); }
  // These want the program in use. Setting a uniform that the shader does not use does nothing.
  void set(const char* name, int value) const { glUniform1i(location(name), value); }
  void set(const char* name, float value) const { glUniform1f(location(name), value); }
  void set(const char* name, const glm::vec2& value) const { glUniform2fv(location(name), 1, &value.x); }
  void set(const char* name, const glm::vec3& value) const { glUniform3fv(location(name), 1, &value.x); }
  void set(const char* name, const glm::vec4& value) const { glUniform4fv(location(name), 1, &value.x); }
  void set(const char* name, const glm::mat4& value) const { glUniformMatrix4fv(location(name), 1, 0, &value[0].x); }

 private:
  GLint location(const char* name) const;

  GlName<detail::delete_program> name_;
  mutable std::unordered_map<std::string, GLint> locations_;
};

/// An off-screen picture: RGBA8 (sRGB values, stored as they are) with 24-bit depth, multisampled if asked for.
class Framebuffer {
 public:
  /// `size` at least 1 x 1; `samples` is cut down to what the driver can do. Throws std::runtime_error.
  explicit Framebuffer(glm::ivec2 size, int samples = 4);

  glm::ivec2 size() const { return size_; }
  int samples() const { return samples_; }  // 0 if not multisampled
  void bind() const;                        // for drawing, and sets the viewport to the whole of it
  Image read() const;                       // resolves the samples first; leaves this framebuffer bound

 private:
  void attach(GLuint framebuffer, GLuint colour, GLuint depth, int samples) const;

  glm::ivec2 size_;
  int samples_;
  GlName<detail::delete_framebuffer> framebuffer_, resolved_;
  GlName<detail::delete_renderbuffer> colour_, depth_, resolved_colour_;
};

/// Reads the colours of a framebuffer without multisampling, e.g. 0 for the window's back buffer.
Image read_pixels(GLuint framebuffer, glm::ivec2 size);

}  // namespace engine
