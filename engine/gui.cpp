#include "engine/gui.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <cassert>
#include <cfloat>
#include <cmath>
#include <utility>

#include "engine/gui_theme.h"
#include "engine/window.h"

namespace engine {
namespace {

constexpr float font_height = 15.0f;  // pixels at scale 1

void feed_mouse(ImGuiIO& io, const glm::vec2& position, const std::array<bool, 3>& buttons) {
#if IMGUI_VERSION_NUM >= 18700
  io.AddMousePosEvent(position.x, position.y);
  for (int i = 0; i < 3; ++i) io.AddMouseButtonEvent(i, buttons[static_cast<std::size_t>(i)]);
#else
  io.MousePos = {position.x, position.y};
  for (std::size_t i = 0; i < 3; ++i) io.MouseDown[i] = buttons[i];
#endif
}

void feed_wheel(ImGuiIO& io, float steps) {
#if IMGUI_VERSION_NUM >= 18700
  if (steps != 0.0f) io.AddMouseWheelEvent(0.0f, steps);
#else
  io.MouseWheel += steps;
#endif
}

void feed_key(GLFWwindow* window, const KeyEvent& event) {
#if IMGUI_VERSION_NUM >= 18700
  // The backend asks GLFW for the letter on the key and for the modifiers of now. Those of the event are given to ImGui
  // afterwards; `mods` does not yet count a change by the event itself.
  ImGui_ImplGlfw_KeyCallback(window, event.key, event.scancode, event.action, event.mods);
  struct Modifier {
    ImGuiKey imgui_key;
    int bit, left, right;
  };
  for (const Modifier& m : {Modifier{ImGuiMod_Ctrl, GLFW_MOD_CONTROL, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL},
                            Modifier{ImGuiMod_Shift, GLFW_MOD_SHIFT, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT},
                            Modifier{ImGuiMod_Alt, GLFW_MOD_ALT, GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT},
                            Modifier{ImGuiMod_Super, GLFW_MOD_SUPER, GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER}}) {
    const bool is_modifier = event.key == m.left || event.key == m.right;
    ImGui::GetIO().AddKeyEvent(m.imgui_key, is_modifier ? event.action != GLFW_RELEASE : (event.mods & m.bit) != 0);
  }
#else
  const int key = event.meaning.key;  // so that Ctrl+A is the key labelled A
  ImGui_ImplGlfw_KeyCallback(window, key, event.scancode, event.action, event.mods);
#endif
}

void create_imgui() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // the program places all windows itself
#if IMGUI_VERSION_NUM >= 18700
  // InputQueue distributes the input over frames, also for older versions of ImGui. With a second queue in ImGui,
  // nobody would know which widget receives what is typed.
  ImGui::GetIO().ConfigInputTrickleEventQueue = false;
#endif
}

}  // namespace

Gui::Gui(Window& window) : window_(&window) {
  create_imgui();
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), false);  // false: take_input() passes mouse and keys on
  glfwSetWindowFocusCallback(window.handle(), ImGui_ImplGlfw_WindowFocusCallback);
  glfwSetCursorEnterCallback(window.handle(), ImGui_ImplGlfw_CursorEnterCallback);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  apply_scale(window.content_scale(), window.pixel_ratio());
}

Gui::Gui(float scale) {
  create_imgui();
  ImGui::GetIO().BackendPlatformName = "headless";
  ImGui_ImplOpenGL3_Init("#version 330 core");
  apply_scale(scale, 1.0f);
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  if (window_ != nullptr) {
    glfwSetWindowFocusCallback(window_->handle(), nullptr);
    glfwSetCursorEnterCallback(window_->handle(), nullptr);
    ImGui_ImplGlfw_Shutdown();
  }
  ImGui::DestroyContext();
}

// ImGui's units are screen coordinates. The font is rasterised at the size of framebuffer pixels, so that it is sharp.
void Gui::apply_scale(float content_scale, float pixel_ratio) {
  if (content_scale == content_scale_ && pixel_ratio == pixel_ratio_) return;
  content_scale_ = content_scale;
  pixel_ratio_ = pixel_ratio;
  scale_ = content_scale / pixel_ratio;
  apply_theme(scale_);
  load_font(std::round(font_height * content_scale));
  ImGui::GetIO().FontGlobalScale = 1.0f / pixel_ratio;
  ImGui_ImplOpenGL3_DestroyDeviceObjects();  // the next frame creates them again, with this font
}

void Gui::begin_frame() {
  assert(window_ != nullptr);
  apply_scale(window_->content_scale(), window_->pixel_ratio());
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  take_input();
  ImGui::NewFrame();
}

void Gui::take_input() {
  ImGuiIO& io = ImGui::GetIO();
  const bool typing = wants_keyboard();
  glm::vec2 mouse(-FLT_MAX);  // for ImGui: outside the window
  if (glfwGetWindowAttrib(window_->handle(), GLFW_FOCUSED) || glfwGetWindowAttrib(window_->handle(), GLFW_HOVERED))
    mouse = window_->cursor() / window_->pixel_ratio();
  const std::vector<InputEvent> events = window_->take_input();
  for (const KeyPress& press : key_translator_.translate(events))
    if (!typing) key_presses_.push_back(press);
  for (const InputEvent& event : events) {
    if (const auto* key = std::get_if<KeyEvent>(&event)) {
      feed_key(window_->handle(), *key);
    } else if (const auto* character = std::get_if<CharacterEvent>(&event)) {
      // Without this test, shortcuts before a click would become the first characters in the clicked text field.
      if (typing) ImGui_ImplGlfw_CharCallback(window_->handle(), character->code);
    } else if (const auto* scroll = std::get_if<ScrollEvent>(&event)) {
      ImGui_ImplGlfw_ScrollCallback(window_->handle(), scroll->steps.x, scroll->steps.y);
    } else if (const auto& button = std::get<ButtonEvent>(event);
               button.button >= 0 && button.button < static_cast<int>(buttons_.size())) {
      const auto which = static_cast<std::size_t>(button.button);
      buttons_[which] = button.down;
      mouse = button.position;
      if (!button.down) continue;
      // ImGui measures the time in frames, so in slow frames every double-click would be two clicks.
      constexpr double double_click_time = 0.3;  // s
      io.MouseDoubleClickTime = button.earliest - last_press_[which] < double_click_time ? FLT_MAX : 0.0f;
      last_press_[which] = button.latest;
    }
  }
  feed_mouse(io, mouse, buttons_);
}

std::vector<KeyPress> Gui::take_key_presses() { return std::exchange(key_presses_, {}); }

void Gui::begin_frame(const GuiInput& input) {
  assert(window_ == nullptr && input.seconds > 0.0f);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(input.display_size.x), static_cast<float>(input.display_size.y)};
  io.DeltaTime = input.seconds;
  feed_mouse(io, input.mouse, input.buttons);
  feed_wheel(io, input.wheel);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

void Gui::end_frame() { ImGui::Render(); }

void Gui::draw() const { ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData()); }

bool Gui::wants_mouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool Gui::wants_keyboard() const {
  // io.WantTextInput would be one frame late.
  return ImGui::IsAnyItemActive() && ImGui::GetInputTextState(ImGui::GetActiveID()) != nullptr;
}

}  // namespace engine
