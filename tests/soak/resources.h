#pragma once
// What the process holds of the machine's.

#include <string>

namespace soak {

struct Resources {
  double megabytes = 0;  // resident
  int descriptors = 0;   // open files, sockets and pipes
  int gl_objects = 0;    // buffers, textures, ... of the current context
};

/// Needs a current context.
Resources resources();
std::string describe(const Resources& held);

}  // namespace soak
