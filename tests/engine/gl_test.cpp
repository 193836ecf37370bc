#include "engine/gl.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/engine/drawing_context.h"

namespace engine {
namespace THIS_FILE {

TEST(Framebuffer, ReadsRowsFromTheTop) {
  const DrawingContext context;
  for (const int samples : {0, 4}) {
    const Framebuffer framebuffer({8, 4}, samples);
    framebuffer.bind();
    glClearColor(0.0f, 0.0f, 1.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 3, 8, 1);  // OpenGL's top row
    glClearColor(1.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
    const Image image = framebuffer.read();
    EXPECT_EQ(image.at(5, 0), glm::u8vec4(255, 0, 0, 255));
    EXPECT_EQ(image.at(5, 1), glm::u8vec4(0, 0, 255, 255));
  }
}

TEST(Framebuffer, ReducesSamplesToWhatTheDriverSupports) {
  const DrawingContext context;
  for (const int samples : {1000, 1, -1}) EXPECT_NO_THROW(Framebuffer({4, 4}, samples)) << samples;
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(Framebuffer, RefusesUnsupportedSizes) {
  const DrawingContext context;
  for (const glm::ivec2 size : {glm::ivec2(0, 10), glm::ivec2(10, -1), glm::ivec2(1 << 20, 10)}) {
    EXPECT_THROW(Framebuffer{size}, std::runtime_error);
  }
}

}  // namespace THIS_FILE
}  // namespace engine
