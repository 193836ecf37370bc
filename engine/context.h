#pragma once
// What windows and headless contexts share: the error type, and loading OpenGL's functions.

#include <stdexcept>

namespace engine {

/// There is no display, or neither OpenGL 3.3 nor OpenGL ES 3.0. what() is one line: what is missing, and what to do
/// about it.
struct ContextError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Loads the OpenGL functions of the current context; Window and HeadlessContext call it. Throws ContextError if the
/// version is below 3.3, or below 3.0 for OpenGL ES. WebGL 2 is OpenGL ES 3.0.
void load_opengl();

/// Returns the version line of the current context's shading language, without a line end.
const char* glsl_version();

/// True if the current context draws on the CPU, where the time grows with every pixel.
bool uses_software_renderer();

}  // namespace engine
