// Preloaded, it makes the driver say once that its context was lost: software drivers never lose one by themselves.
// For each context that is made it writes a line to the file that LOST_CONTEXT_LOG names.

#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <fstream>

namespace {

using Function = void (*)();

/// In the place of glGetGraphicsResetStatus.
unsigned reset_status() {
  constexpr int when = 60;  // calls, one a frame
  constexpr unsigned guilty_context_reset = 0x8253;
  static int calls = 0;
  return ++calls == when ? guilty_context_reset : 0;
}

}  // namespace

/// What GLEW asks for every function's address.
extern "C" Function glXGetProcAddressARB(const unsigned char* name) {
  using Lookup = Function (*)(const unsigned char*);
  if (std::strcmp(reinterpret_cast<const char*>(name), "glGetGraphicsResetStatus") == 0) {
    std::ofstream(std::getenv("LOST_CONTEXT_LOG"), std::ios::app) << "context\n";
    return reinterpret_cast<Function>(&reset_status);
  }
  static const auto driver = reinterpret_cast<Lookup>(::dlsym(RTLD_NEXT, "glXGetProcAddressARB"));
  return driver(name);
}
