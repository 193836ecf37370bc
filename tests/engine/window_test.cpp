#include "engine/window.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <string>

#include "engine/camera.h"
#include "engine/context.h"
#include "engine/gl.h"
#include "engine/gui.h"
#include "engine/render/renderer.h"
#include "engine/resources.h"
// After GLEW, which must be the first.
#include <GLFW/glfw3.h>
#include <imgui.h>

namespace engine {
namespace THIS_FILE {

TEST(Window, ErrorWithoutADisplaySaysWhatToDo) {
  const char* display = std::getenv("DISPLAY");
  const std::string before = display != nullptr ? display : "";
  ::setenv("DISPLAY", ":9999", 1);
  try {
    const Window window("test", {400, 300});
    ADD_FAILURE() << "a window without a display";
  } catch (const ContextError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("cannot open a window"), std::string::npos) << message;
    EXPECT_NE(message.find("simulate"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  before.empty() ? ::unsetenv("DISPLAY") : ::setenv("DISPLAY", before.c_str(), 1);
}

TEST(Window, ShowsASceneAndAPanel) {
  Window window("test", {400, 300});
  Gui gui(window);
  render::Renderer renderer(find_folder("shaders"));
  FrameData frame;
  frame.floor_height = 0.0f;
  frame.spheres = {{{0.0f, 1.0f, 0.0f}, 1.0f, {0.9f, 0.2f, 0.2f}}};
  frame.lines = {
      {.lines = {{{-1, 0, 0}, {1, 2, 0}, glm::vec4(1)}}, .width = 3}};  // not every context supports wide lines
  Camera camera;
  for (int i = 0; i < 3; ++i) {
    window.poll();
    const glm::ivec2 size = window.framebuffer_size();
    camera.fit({0.0f, 1.0f, 0.0f}, 1.2f, size);
    renderer.draw(camera, {glm::ivec2(0), size}, frame);
    gui.begin_frame();
    gui.end_frame();
    gui.draw();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    window.present();
  }
  EXPECT_TRUE(window.is_open());
  EXPECT_FALSE(window.minimised());
  EXPECT_GE(window.content_scale(), 0.5f);
  // Calls the callback as GLFW does when two files are dropped.
  const GLFWdropfun drop = glfwSetDropCallback(window.handle(), nullptr);
  ASSERT_NE(drop, nullptr);
  const char* files[]{"/a/star.obj", "/a/b c.toml"};
  drop(window.handle(), 2, files);
  window.poll();  // another poll() does not lose the files
  EXPECT_EQ(window.take_dropped_files(), (std::vector<std::string>{"/a/star.obj", "/a/b c.toml"}));
  EXPECT_TRUE(window.take_dropped_files().empty());
  glfwSetWindowShouldClose(window.handle(), GLFW_TRUE);  // as when the user closes it
  EXPECT_FALSE(window.is_open());
}

/// Polls until `done`; false if that takes too long.
bool poll_until(Window& window, auto done) {
  for (int i = 0; i < 100; ++i) {
    window.poll(0.05);
    if (done()) return true;
  }
  return false;
}

TEST(Window, TellsOfEventsAndWaitsInVainWithoutAny) {
  Window window("test", {400, 300});
  ASSERT_TRUE(poll_until(window, [&] { return !window.poll(0.05); })) << "those of its opening come to an end";
  const GLFWcursorposfun on_cursor = glfwSetCursorPosCallback(window.handle(), nullptr);
  on_cursor(window.handle(), 20, 30);
  EXPECT_TRUE(window.poll());
  EXPECT_FALSE(window.poll());
  glfwPostEmptyEvent();
  EXPECT_TRUE(window.poll(60)) << "an event ends the wait";
}

TEST(Window, IsMinimisedWhileNobodyCanSeeIt) {
  Window window("test", {400, 300});
  glfwHideWindow(window.handle());
  EXPECT_TRUE(poll_until(window, [&] { return window.minimised(); }));
  glfwShowWindow(window.handle());
  EXPECT_TRUE(poll_until(window, [&] { return !window.minimised(); }));
}

/// Sends mouse and keyboard events to a window that shows a text field at a known place.
class WindowInputTest : public testing::Test {
 protected:
  void frame() {
    gui.begin_frame();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({200, 200});
    ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoTitleBar);
    ImGui::SetCursorScreenPos({20, 20});
    ImGui::InputText("##field", text.data(), text.size());
    ImGui::End();
    double_clicked |= ImGui::IsMouseDoubleClicked(0);
    clicked += ImGui::IsMouseClicked(0);
    if (ImGui::IsMouseClicked(0)) clicked_at = {ImGui::GetMousePos().x, ImGui::GetMousePos().y};
    gui.end_frame();
    gui.draw();
    for (const KeyPress& key : gui.take_key_presses()) shortcuts += static_cast<char>(key.key);
  }
  void frames() {
    do frame();
    while (window.has_pending_input());
  }
  void move(double x, double y) { on_cursor(window.handle(), x, y); }
  void click() {
    for (const int action : {GLFW_PRESS, GLFW_RELEASE}) on_button(window.handle(), GLFW_MOUSE_BUTTON_LEFT, action, 0);
  }
  void type(const std::string& capitals) {
    for (const char c : capitals) {
      on_key(window.handle(), c, 0, GLFW_PRESS, 0);
      on_character(window.handle(), static_cast<unsigned char>(c));
      on_key(window.handle(), c, 0, GLFW_RELEASE, 0);
    }
  }

  Window window{"test", {400, 300}};
  Gui gui{window};
  const GLFWcursorposfun on_cursor = glfwSetCursorPosCallback(window.handle(), nullptr);
  const GLFWmousebuttonfun on_button = glfwSetMouseButtonCallback(window.handle(), nullptr);
  const GLFWkeyfun on_key = glfwSetKeyCallback(window.handle(), nullptr);
  const GLFWcharfun on_character = glfwSetCharCallback(window.handle(), nullptr);
  std::array<char, 32> text{};
  std::string shortcuts;
  int clicked = 0;
  bool double_clicked = false;
  glm::vec2 clicked_at{0.0f};
};

TEST_F(WindowInputTest, KeysAfterAClickInTheSamePollGoToTheClickedWidget) {
  frames();
  type("12");
  move(30, 30);
  click();
  type("34");
  move(300, 200);
  frames();
  EXPECT_EQ(shortcuts, "12");
  EXPECT_STREQ(text.data(), "34");
  click();  // beside the field
  type("5");
  frames();
  EXPECT_EQ(shortcuts, "125");
  EXPECT_STREQ(text.data(), "34");
}

TEST_F(WindowInputTest, AKeyKeepsItsModifiers) {
  frames();
  move(30, 30);
  click();
  type("12");
  on_key(window.handle(), GLFW_KEY_LEFT_CONTROL, 0, GLFW_PRESS, 0);
  on_key(window.handle(), GLFW_KEY_A, 0, GLFW_PRESS, GLFW_MOD_CONTROL);
  on_key(window.handle(), GLFW_KEY_A, 0, GLFW_RELEASE, GLFW_MOD_CONTROL);
  on_key(window.handle(), GLFW_KEY_LEFT_CONTROL, 0, GLFW_RELEASE, GLFW_MOD_CONTROL);
  type("3");  // replaces the selected text
  frames();
  EXPECT_STREQ(text.data(), "3");
  EXPECT_EQ(shortcuts, "");
}

TEST_F(WindowInputTest, AClickIsAtThePlaceOfThePress) {
  frames();
  move(321, 234);
  click();
  move(20, 10);
  frames();
  EXPECT_EQ(clicked, 1);
  EXPECT_EQ(clicked_at, glm::vec2(321, 234));
  EXPECT_FALSE(double_clicked);
}

TEST_F(WindowInputTest, TwoClicksInOnePollAreADoubleClick) {
  frames();
  move(300, 200);
  click();
  click();
  frames();
  EXPECT_EQ(clicked, 2);
  EXPECT_TRUE(double_clicked);
}

}  // namespace THIS_FILE
}  // namespace engine
