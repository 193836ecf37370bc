// A library to preload: it reports once that the OpenGL context was lost, as software drivers never lose one. For each
// new context it writes a line to the file that LOST_CONTEXT_LOG names.

#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <fstream>

namespace {

using Function = void (*)();

/// Replaces glGetGraphicsResetStatus, which the program calls once a frame. The reset lasts a few calls. With
/// LOST_CONTEXT_AGAIN there is another reset in the first frame after it.
unsigned reset_status() {
  constexpr int first = 60, duration = 3;  // calls
  constexpr unsigned guilty_context_reset = 0x8253;
  static const int again = std::getenv("LOST_CONTEXT_AGAIN") ? first + duration + 1 : -duration;
  static int calls = 0;
  ++calls;
  const bool lost = (calls >= first && calls < first + duration) || (calls >= again && calls < again + duration);
  return lost ? guilty_context_reset : 0;
}

}  // namespace

/// GLEW calls this for each function's address.
extern "C" Function glXGetProcAddressARB(const unsigned char* name) {
  using Lookup = Function (*)(const unsigned char*);
  if (std::strcmp(reinterpret_cast<const char*>(name), "glGetGraphicsResetStatus") == 0) {
    if (const char* log = std::getenv("LOST_CONTEXT_LOG")) std::ofstream(log, std::ios::app) << "context\n";
    return reinterpret_cast<Function>(&reset_status);
  }
  static const auto driver = reinterpret_cast<Lookup>(::dlsym(RTLD_NEXT, "glXGetProcAddressARB"));
  return driver(name);
}
