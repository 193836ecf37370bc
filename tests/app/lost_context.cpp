// Preloaded, it makes the driver say once that its context was lost: software drivers never lose one by themselves.
// For each context that is made it writes a line to the file that LOST_CONTEXT_LOG names.

#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <fstream>

namespace {

using Function = void (*)();

/// In the place of glGetGraphicsResetStatus, which the program asks once a frame. A reset takes some time. With
/// LOST_CONTEXT_AGAIN there is another one in the first frame after it.
unsigned reset_status() {
  constexpr int first = 60, takes = 3;  // calls
  constexpr unsigned guilty_context_reset = 0x8253;
  static const int again = std::getenv("LOST_CONTEXT_AGAIN") ? first + takes + 1 : -takes;
  static int calls = 0;
  ++calls;
  const bool lost = (calls >= first && calls < first + takes) || (calls >= again && calls < again + takes);
  return lost ? guilty_context_reset : 0;
}

}  // namespace

/// What GLEW asks for every function's address.
extern "C" Function glXGetProcAddressARB(const unsigned char* name) {
  using Lookup = Function (*)(const unsigned char*);
  if (std::strcmp(reinterpret_cast<const char*>(name), "glGetGraphicsResetStatus") == 0) {
    if (const char* log = std::getenv("LOST_CONTEXT_LOG")) std::ofstream(log, std::ios::app) << "context\n";
    return reinterpret_cast<Function>(&reset_status);
  }
  static const auto driver = reinterpret_cast<Lookup>(::dlsym(RTLD_NEXT, "glXGetProcAddressARB"));
  return driver(name);
}
