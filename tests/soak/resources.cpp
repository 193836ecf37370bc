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

/// Drivers use the lowest free name, so the names of objects stay far below this.
constexpr GLuint max_names = 4096;

int count_gl_objects() {
  const auto alive = [](GLuint name) {
    return glIsBuffer(name) + glIsTexture(name) + glIsVertexArray(name) + glIsFramebuffer(name) +
           glIsRenderbuffer(name) + glIsProgram(name) + glIsShader(name);
  };
  int count = 0;
  for (GLuint name = 1; name < max_names; ++name) count += alive(name);
  return count;
}

}  // namespace

Resources resources() {
  namespace fs = std::filesystem;
  malloc_trim(0);  // freed memory goes back to the system
  Resources used;
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  used.megabytes = double(resident) * double(sysconf(_SC_PAGESIZE)) / (1 << 20);
  used.descriptors = int(std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator()));
  used.gl_objects = count_gl_objects();
  return used;
}

std::string describe(const Resources& used) {
  return fmt::format("{:.0f} MiB, {} descriptors, {} GL objects", used.megabytes, used.descriptors, used.gl_objects);
}

}  // namespace soak
