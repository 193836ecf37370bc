#include "engine/gui.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cmath>

#include "engine/gui_theme.h"
#include "engine/window.h"

namespace engine {
namespace {

constexpr float font_height = 15.0f;  // pixels of the design

void feed(ImGuiIO& io, const GuiInput& input) {
#if IMGUI_VERSION_NUM >= 18700
  io.AddMousePosEvent(input.mouse.x, input.mouse.y);
  for (int i = 0; i < 3; ++i) io.AddMouseButtonEvent(i, input.buttons[static_cast<std::size_t>(i)]);
  if (input.wheel != 0.0f) io.AddMouseWheelEvent(0.0f, input.wheel);
#else
  io.MousePos = {input.mouse.x, input.mouse.y};
  for (std::size_t i = 0; i < 3; ++i) io.MouseDown[i] = input.buttons[i];
  io.MouseWheel += input.wheel;
#endif
}

}  // namespace

Gui::Gui(Window& window, const std::filesystem::path& settings) : window_(&window) {
  create(settings);
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  apply_scale(window.content_scale(), window.pixel_ratio());
}

Gui::Gui(float scale) {
  create({});
  ImGui::GetIO().BackendPlatformName = "headless";
  ImGui_ImplOpenGL3_Init("#version 330 core");
  apply_scale(scale, 1.0f);
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  if (window_ != nullptr) ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::create(const std::filesystem::path& settings) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  settings_ = settings.string();
  ImGui::GetIO().IniFilename = settings_.empty() ? nullptr : settings_.c_str();
}

// ImGui's units are screen coordinates; the font is made of framebuffer pixels, so that it stays sharp.
void Gui::apply_scale(float content_scale, float pixel_ratio) {
  if (content_scale == content_scale_ && pixel_ratio == pixel_ratio_) return;
  content_scale_ = content_scale;
  pixel_ratio_ = pixel_ratio;
  scale_ = content_scale / pixel_ratio;
  apply_theme(scale_);
  load_font(std::round(font_height * content_scale));
  ImGui::GetIO().FontGlobalScale = 1.0f / pixel_ratio;
  ImGui_ImplOpenGL3_DestroyDeviceObjects();  // the next frame makes them anew, with this font
}

void Gui::begin_frame() {
  apply_scale(window_->content_scale(), window_->pixel_ratio());
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Gui::begin_frame(const GuiInput& input) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(input.display_size.x), static_cast<float>(input.display_size.y)};
  io.DeltaTime = input.seconds;
  feed(io, input);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

void Gui::end_frame() { ImGui::Render(); }

void Gui::draw() const { ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData()); }

bool Gui::wants_mouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool Gui::wants_keyboard() const { return ImGui::GetIO().WantTextInput; }

}  // namespace engine
