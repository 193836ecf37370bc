#include "tests/soak/resources.h"

#include <GL/glew.h>
#include <fmt/core.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace soak {
namespace {

/// Drivers hand out the lowest name that is free, so that no object is far beyond this.
constexpr GLuint names_tried = 4096;

int count_gl_objects() {
  const auto alive = [](GLuint name) {
    return glIsBuffer(name) + glIsTexture(name) + glIsVertexArray(name) + glIsFramebuffer(name) +
           glIsRenderbuffer(name) + glIsProgram(name) + glIsShader(name);
  };
  int count = 0;
  for (GLuint name = 1; name < names_tried; ++name) count += alive(name);
  return count;
}

}  // namespace

Resources resources() {
  namespace fs = std::filesystem;
  malloc_trim(0);  // what is freed is not held
  Resources held;
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  held.megabytes = double(resident) * double(sysconf(_SC_PAGESIZE)) / (1 << 20);
  held.descriptors = int(std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator()));
  held.gl_objects = count_gl_objects();
  return held;
}

std::string describe(const Resources& held) {
  return fmt::format("{:.0f} MiB, {} descriptors, {} GL objects", held.megabytes, held.descriptors, held.gl_objects);
}

}  // namespace soak
