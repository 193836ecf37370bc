#pragma once
// Shader programs, read from GLSL files at run time.

#include <filesystem>
#include <glm/mat4x4.hpp>
#include <stdexcept>
#include <string>

#include "engine/gl.h"

namespace engine {

/// A shader does not compile or link, or its file cannot be read. what() begins with "file:line: " if the driver names
/// the line.
struct ShaderError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the text of a shader for a driver. It begins with the line `version`, see glsl_version(); a line
/// `#include "name"` in `file` inserts a file of the same folder. Throws ShaderError.
std::string shader_text(const std::filesystem::path& file, const std::string& version);

/// A vertex and a fragment shader, each a shader_text(). The uniform block "Frame" reads binding point 0.
class Program {
 public:
  /// Throws ShaderError.
  Program(const std::filesystem::path& folder, const std::string& vertex_file, const std::string& fragment_file);

  void use() const { glUseProgram(name_.get()); }
  // The program must be in use. Setting a uniform that the shaders do not use has no effect.
  void set(const char* name, int value) const { glUniform1i(location(name), value); }
  void set(const char* name, float value) const { glUniform1f(location(name), value); }
  void set(const char* name, const glm::vec3& value) const { glUniform3fv(location(name), 1, &value.x); }
  void set(const char* name, const glm::mat4& value) const { glUniformMatrix4fv(location(name), 1, 0, &value[0].x); }

 private:
  GLint location(const char* name) const;

  GlName<detail::delete_program> name_;
};

}  // namespace engine
