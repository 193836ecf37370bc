#include "engine/window.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "engine/camera.h"
#include "engine/context.h"
#include "engine/gl.h"
#include "engine/gui.h"
#include "engine/renderer.h"
#include "engine/resources.h"
// After GLEW, which wants to be first.
#include <GLFW/glfw3.h>

namespace engine {
namespace {

TEST(WindowTest, SaysWhatToDoWithoutADisplay) {
  const char* display = std::getenv("DISPLAY");
  const std::string before = display != nullptr ? display : "";
  ::setenv("DISPLAY", ":9999", 1);
  try {
    const Window window;
    ADD_FAILURE() << "a window without a display";
  } catch (const Unavailable& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("cannot open a window"), std::string::npos) << message;
    EXPECT_NE(message.find("simulate"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  before.empty() ? ::unsetenv("DISPLAY") : ::setenv("DISPLAY", before.c_str(), 1);
}

TEST(WindowTest, ShowsASceneAndAPanel) {
  Window window({.title = "test", .size = {400, 300}, .samples = 4, .vsync = false});
  Gui gui(window);
  Renderer renderer(find_folder("shaders"));
  FrameData frame;
  frame.ground = 0.0f;
  frame.spheres = {{{0.0f, 1.0f, 0.0f}, 1.0f, {0.9f, 0.2f, 0.2f}}};
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
  EXPECT_TRUE(window.open());
  EXPECT_FALSE(window.minimised());
  EXPECT_GE(window.content_scale(), 0.5f);
  // As the desktop does when two files are dropped.
  const GLFWdropfun drop = glfwSetDropCallback(window.handle(), nullptr);
  ASSERT_NE(drop, nullptr);
  const char* files[]{"/a/star.obj", "/a/b c.toml"};
  drop(window.handle(), 2, files);
  window.poll();  // polled again before it is taken: nothing gets lost
  EXPECT_EQ(window.take_dropped_files(), (std::vector<std::string>{"/a/star.obj", "/a/b c.toml"}));
  EXPECT_TRUE(window.take_dropped_files().empty());
  window.close();
  EXPECT_FALSE(window.open());
}

}  // namespace
}  // namespace engine
