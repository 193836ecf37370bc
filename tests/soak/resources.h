#pragma once
// What the process uses of memory, files and OpenGL.

#include <string>

namespace soak {

struct Resources {
  double megabytes = 0;  // resident
  int descriptors = 0;   // open files, sockets and pipes
  int gl_objects = 0;    // buffers, textures, ... of the current context
};

/// Counts what the process uses now. Needs a current context.
Resources resources();
std::string describe(const Resources& used);

}  // namespace soak
