#pragma once
// What windows and headless contexts share: how they fail, and how OpenGL's functions are loaded.

#include <stdexcept>
#include <string>

namespace engine {

/// There is no display or no OpenGL 3.3 here. what() is one line that says what is missing and what to do about it.
class Unavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Loads the OpenGL functions of the current context and checks for version 3.3. Window and HeadlessContext call it.
void load_gl();

/// Name and version of the current context's driver, e.g. "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 ...".
std::string gl_description();

/// Whether that driver computes pictures on the processor, so that every pixel counts.
bool draws_in_software();

}  // namespace engine
