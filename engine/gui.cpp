#include "engine/gui.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cfloat>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>

#include "engine/context.h"
#include "engine/resources.h"
#include "engine/window.h"

namespace engine {
namespace {

// Font files of Debian, Ubuntu, Fedora and Arch, best font first.
constexpr std::array font_files{
    "/usr/share/fonts/opentype/inter/Inter-Regular.otf",
    "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf",
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
};

// First and last characters: Latin, Greek, dashes and quotes, superscripts, arrows, mathematical signs, simple shapes.
constexpr std::array<ImWchar, 15> glyph_ranges{0x0020, 0x00ff, 0x0370, 0x03ff, 0x2010, 0x2027, 0x2070, 0x209f,
                                               0x2190, 0x2199, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};

ImVec4 rgba(unsigned rgb, float alpha = 1.0f) {
  const auto channel = [&](int shift) { return static_cast<float>((rgb >> shift) & 0xffu) / 255.0f; };
  return {channel(16), channel(8), channel(0), alpha};
}

void set_colours(ImVec4* colours) {
  const unsigned ink = 0x22272e, accent = 0x2f6fb5;
  colours[ImGuiCol_Text] = rgba(ink);
  colours[ImGuiCol_TextDisabled] = rgba(0x5f6873);  // contrast 5 to 1 on the docks
  colours[ImGuiCol_WindowBg] = rgba(0xf8f9fa, 0.95f);
  colours[ImGuiCol_ChildBg] = rgba(0xffffff, 0.0f);
  colours[ImGuiCol_PopupBg] = rgba(0xffffff, 0.98f);
  colours[ImGuiCol_Border] = rgba(ink, 0.14f);
  colours[ImGuiCol_FrameBg] = rgba(ink, 0.07f);
  colours[ImGuiCol_FrameBgHovered] = rgba(accent, 0.16f);
  colours[ImGuiCol_FrameBgActive] = rgba(accent, 0.24f);
  colours[ImGuiCol_TitleBg] = colours[ImGuiCol_TitleBgActive] = rgba(0xebedf0);
  colours[ImGuiCol_TitleBgCollapsed] = rgba(0xebedf0, 0.85f);
  colours[ImGuiCol_MenuBarBg] = rgba(0xf0f2f4);
  colours[ImGuiCol_ScrollbarBg] = rgba(ink, 0.0f);
  colours[ImGuiCol_ScrollbarGrab] = rgba(ink, 0.20f);
  colours[ImGuiCol_ScrollbarGrabHovered] = rgba(ink, 0.32f);
  colours[ImGuiCol_ScrollbarGrabActive] = rgba(ink, 0.45f);
  colours[ImGuiCol_CheckMark] = rgba(accent);
  colours[ImGuiCol_SliderGrab] = rgba(accent, 0.85f);
  colours[ImGuiCol_SliderGrabActive] = rgba(accent);
  colours[ImGuiCol_Button] = rgba(ink, 0.08f);
  colours[ImGuiCol_ButtonHovered] = rgba(accent, 0.20f);
  colours[ImGuiCol_ButtonActive] = rgba(accent, 0.34f);
  colours[ImGuiCol_Header] = rgba(accent, 0.13f);
  colours[ImGuiCol_HeaderHovered] = rgba(accent, 0.20f);
  colours[ImGuiCol_HeaderActive] = rgba(accent, 0.28f);
  colours[ImGuiCol_Separator] = rgba(ink, 0.12f);
  colours[ImGuiCol_ResizeGrip] = rgba(ink, 0.0f);
  colours[ImGuiCol_ResizeGripHovered] = rgba(accent, 0.25f);
  colours[ImGuiCol_ResizeGripActive] = rgba(accent, 0.45f);
  colours[ImGuiCol_Tab] = rgba(ink, 0.05f);
  colours[ImGuiCol_TabHovered] = rgba(accent, 0.22f);
  colours[ImGuiCol_TableHeaderBg] = rgba(ink, 0.06f);
  colours[ImGuiCol_TableBorderStrong] = rgba(ink, 0.16f);
  colours[ImGuiCol_TableBorderLight] = rgba(ink, 0.08f);
  colours[ImGuiCol_TableRowBgAlt] = rgba(ink, 0.03f);
  colours[ImGuiCol_PlotLines] = colours[ImGuiCol_PlotHistogram] = rgba(accent);
  colours[ImGuiCol_PlotLinesHovered] = colours[ImGuiCol_PlotHistogramHovered] = rgba(0xd9822b);
  colours[ImGuiCol_TextSelectedBg] = rgba(accent, 0.28f);
  colours[ImGuiCol_ModalWindowDimBg] = rgba(ink, 0.25f);
}

bool is_readable(const std::string& file) { return std::ifstream(file).good(); }

/// Sets ImGui's colours and its sizes, multiplied by `scale` > 0.
void apply_theme(float scale) {
  assert(scale > 0.0f);
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  ImGui::StyleColorsLight(&style);
  set_colours(style.Colors);
  style.DisabledAlpha = 0.7f;  // keeps a contrast of 5 to 1 on buttons
  style.WindowPadding = {14.0f, 12.0f};
  style.FramePadding = {8.0f, 4.0f};
  style.ItemSpacing = {8.0f, 6.0f};
  style.ItemInnerSpacing = {8.0f, 4.0f};
  style.WindowRounding = 8.0f;
  style.ChildRounding = style.PopupRounding = 6.0f;
  style.FrameRounding = style.GrabRounding = style.TabRounding = 4.0f;
  style.ScrollbarRounding = 6.0f;
  style.ScrollbarSize = 11.0f;
  style.GrabMinSize = 12.0f;
  style.WindowBorderSize = 1.0f;
  style.WindowTitleAlign = {0.0f, 0.5f};
  style.WindowMenuButtonPosition = ImGuiDir_Right;
  style.ScaleAllSizes(scale);
}

/// Fills ImGui's font atlas with the font among the assets, where the program brings one, or with a system font, or
/// with ImGui's own if none is found. `pixels` > 0 is the height.
void load_font(float pixels) {
  assert(pixels > 0.0f);
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  ImFontConfig config;
  config.OversampleH = 2;
  config.OversampleV = 1;
  config.PixelSnapH = false;
  const auto load = [&](const std::string& file) {
    return is_readable(file) && atlas.AddFontFromFileTTF(file.c_str(), pixels, &config, glyph_ranges.data()) != nullptr;
  };
  if (load((find_folder("assets") / "fonts/Inter-Regular.otf").string()) || std::ranges::any_of(font_files, load))
    return;
  config.SizePixels = pixels;
  atlas.AddFontDefault(&config);
}

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
  ImGui_ImplOpenGL3_Init(glsl_version());
  apply_scale(window.content_scale(), window.pixel_ratio());
}

Gui::Gui(float scale) {
  create_imgui();
  ImGui::GetIO().BackendPlatformName = "headless";
  ImGui_ImplOpenGL3_Init(glsl_version());
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
