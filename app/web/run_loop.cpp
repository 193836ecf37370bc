#include "engine/run_loop.h"

#include <GL/glew.h>
#include <emscripten.h>
#include <emscripten/html5.h>

#include <cstdio>
#include <exception>
#include <utility>

namespace {

struct Loop {
  std::function<bool()> turn;
  bool context_lost = false;
  void next();
} loop;

void Loop::next() {
  const bool lost = emscripten_is_webgl_context_lost(emscripten_webgl_get_current_context());
  context_lost |= lost;
  bool goes_on = false;
  try {
    goes_on = lost || turn();  // the browser brings the context back
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sbcollide: %s\n", error.what());
  }
  if (!goes_on) emscripten_cancel_main_loop();
}

}  // namespace

GLenum glewInit() {
  loop.context_lost = false;
  return GLEW_OK;
}

GLenum glGetGraphicsResetStatus() { return loop.context_lost ? GL_INVALID_OPERATION : GL_NO_ERROR; }

namespace engine {

void run_loop(std::function<bool()> turn) {
  loop.turn = std::move(turn);
  emscripten_set_main_loop_arg([](void*) { loop.next(); }, nullptr, 0, false);
}

}  // namespace engine
