#include "engine/gui.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include "engine/gl.h"
#include "engine/headless.h"

namespace engine {
namespace THIS_FILE {

/// Runs one frame with a button at a known place. Returns true if the button was clicked.
bool frame_with_button(Gui& gui, const GuiInput& input) {
  gui.begin_frame(input);
  ImGui::SetNextWindowPos({20.0f, 20.0f});
  ImGui::SetNextWindowSize({200.0f, 100.0f});
  ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoTitleBar);
  const bool clicked = ImGui::Button("press", {150.0f, 40.0f});
  ImGui::End();
  gui.end_frame();
  gui.draw();
  return clicked;
}

TEST(Gui, MouseClickPressesAButton) {
  const HeadlessContext context;
  const Framebuffer framebuffer({320, 240}, 0);
  framebuffer.bind();
  Gui gui;
  GuiInput input{.display_size = {320, 240}, .mouse = {80.0f, 50.0f}};
  frame_with_button(gui, input);
  frame_with_button(gui, input);
  EXPECT_TRUE(gui.wants_mouse());
  EXPECT_FALSE(gui.wants_keyboard());
  input.buttons[0] = true;
  EXPECT_FALSE(frame_with_button(gui, input));
  input.buttons[0] = false;
  EXPECT_TRUE(frame_with_button(gui, input));
  input.mouse = {300.0f, 200.0f};
  frame_with_button(gui, input);
  frame_with_button(gui, input);
  EXPECT_FALSE(gui.wants_mouse());
}

TEST(Gui, PanelIsLightWithDarkText) {
  const HeadlessContext context;
  const Framebuffer framebuffer({320, 240}, 0);
  framebuffer.bind();
  glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  Gui gui;
  const GuiInput input{.display_size = {320, 240}};
  for (int i = 0; i < 3; ++i) frame_with_button(gui, input);  // ImGui sizes a new window in its first frame
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  const Image image = framebuffer.read();
  EXPECT_EQ(image.at(300, 200), glm::u8vec4(0, 0, 0, 255));
  EXPECT_GT(image.at(210, 110).r, 220);
}

TEST(Gui, ScaleAppliesToFontAndSizes) {
  const HeadlessContext context;
  const auto frame_height = [](float scale) {
    Gui gui(scale);
    gui.begin_frame(GuiInput{});
    const float height = ImGui::GetFrameHeight();
    gui.end_frame();
    gui.draw();
    EXPECT_EQ(gui.scale(), scale);
    return height;
  };
  EXPECT_NEAR(frame_height(2.0f), 2.0f * frame_height(1.0f), 2.0f);
}

}  // namespace THIS_FILE
}  // namespace engine
