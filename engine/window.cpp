#include "engine/window.h"

#include <GL/glew.h>
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <utility>

#include "engine/context.h"
#include "engine/key_translator.h"

namespace engine {
namespace {

std::string last_glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "unknown reason";
}

#ifdef GLFW_PLATFORM
bool is_absolute_path(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value == '/';
}
#endif

/// Returns `wanted`, reduced to the work area of the primary monitor.
glm::ivec2 fitting_size(glm::ivec2 wanted) {
  glm::ivec2 origin(0), area(0);
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor(); monitor != nullptr) {
    glfwGetMonitorWorkarea(monitor, &origin.x, &origin.y, &area.x, &area.y);
  }
  if (area.x <= 0 || area.y <= 0) return wanted;
  return {std::clamp(wanted.x, 1, area.x), std::clamp(wanted.y, 1, area.y)};
}

void set_hints() {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
#ifdef __APPLE__  // offers no other core context; elsewhere it would forbid the wide lines of render/overlay_pass.h
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
#endif
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);  // reports driver resets, if supported
  glfwWindowHint(GLFW_DEPTH_BITS, 24);
  glfwWindowHint(GLFW_ALPHA_BITS, 0);  // a page would show through
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "sbcollide");
}

}  // namespace

Window::Window(const std::string& title, glm::ivec2 wanted) {
  assert(wanted.x > 0 && wanted.y > 0);
#ifdef GLFW_PLATFORM
  // Where no Wayland socket can exist, Wayland's library would print an error before GLFW tried X11.
  if (!is_absolute_path("XDG_RUNTIME_DIR") && !is_absolute_path("WAYLAND_DISPLAY"))
    glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
  if (!glfwInit()) {
    throw ContextError("cannot open a window: " + last_glfw_error() +
                       "; start it in a desktop session (DISPLAY or WAYLAND_DISPLAY set), or use 'simulate'");
  }
  set_hints();
  const glm::ivec2 size = fitting_size(wanted);
  window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string reason = last_glfw_error();
    glfwTerminate();
    throw ContextError("cannot open a window with OpenGL 3.3: " + reason +
                       "; update the graphics driver, or set LIBGL_ALWAYS_SOFTWARE=1");
  }
  try {
    glfwMakeContextCurrent(window_);
    load_opengl();
  } catch (...) {
    glfwTerminate();
    throw;
  }
  set_callbacks();
  glfwSetWindowSizeLimits(window_, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwSwapInterval(1);
  update_size();
}

Window::~Window() { glfwTerminate(); }

bool Window::is_open() const { return !glfwWindowShouldClose(window_); }

bool Window::poll(double seconds) {
  if (minimised()) seconds = 0.25;
#ifdef __EMSCRIPTEN__
  seconds = 0;  // the browser waits
#endif
  const double end = glfwGetTime() + seconds;
  if (seconds > 0) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
  last_poll_ = glfwGetTime();
  update_size();
  constexpr double precision = 1e-3;  // s, of the wait
  return std::exchange(event_, false) || has_pending_input() || last_poll_ < end - precision;
}

void Window::update_size() {
  glfwGetFramebufferSize(window_, &framebuffer_size_.x, &framebuffer_size_.y);
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  pixel_ratio_ = width > 0 ? std::max(1.0f, static_cast<float>(framebuffer_size_.x) / static_cast<float>(width)) : 1.0f;
  minimised_ = glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE ||
               glfwGetWindowAttrib(window_, GLFW_VISIBLE) == GLFW_FALSE || framebuffer_size_.x <= 0 ||
               framebuffer_size_.y <= 0;
}

std::vector<std::string> Window::take_dropped_files() { return std::exchange(dropped_files_, {}); }

void Window::present() { glfwSwapBuffers(window_); }

bool Window::context_lost() const {
  // The version and the extensions decide: a driver may return an address for a function that it does not support.
  if (GLEW_VERSION_4_5 || GLEW_KHR_robustness) return glGetGraphicsResetStatus() != GL_NO_ERROR;
  return GLEW_ARB_robustness && glGetGraphicsResetStatusARB() != GL_NO_ERROR;
}

void Window::wait_for_context_reset() const {
#ifndef __EMSCRIPTEN__  // there run_loop() has waited
  constexpr int max_waits = 100;
  for (int i = 0; i < max_waits && context_lost(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
#endif
}

float Window::content_scale() const {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::clamp(std::max(x, y), 0.5f, 8.0f);  // some X servers report wrong values
}

glm::vec2 Window::cursor() const {
  double x = 0.0, y = 0.0;
  glfwGetCursorPos(window_, &x, &y);
  return glm::vec2(static_cast<float>(x), static_cast<float>(y)) * pixel_ratio();
}

bool Window::left_button_down() const { return glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS; }

void Window::set_callbacks() {
  static constexpr auto self = [](GLFWwindow* window) -> Window& {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
  };
  glfwSetWindowUserPointer(window_, this);
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { self(window).event_ = true; });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    Window& w = self(window);
    w.event_ = true;
    w.dropped_files_.insert(w.dropped_files_.end(), paths, paths + count);
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    self(window).event_ = true;
    self(window).cursor_ = {x, y};
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
    Window& w = self(window);
    w.input_.push(ButtonEvent{button, action == GLFW_PRESS, w.cursor_, w.last_poll_, glfwGetTime()});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double x, double y) {
    self(window).input_.push(ScrollEvent{{x, y}});
  });
  glfwSetCharCallback(window_,
                      [](GLFWwindow* window, unsigned int code) { self(window).input_.push(CharacterEvent{code}); });
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int mods) {
    const KeyMeaning meaning = key_meaning(key, [](int named) { return glfwGetKeyName(named, 0); });
    self(window).input_.push(KeyEvent{key, meaning, scancode, action, mods});
  });
}

}  // namespace engine
