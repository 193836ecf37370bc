#include "engine/gl.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "engine/headless.h"

namespace engine {
namespace {
namespace fs = std::filesystem;

class Gl : public testing::Test {
 protected:
  Gl() { fs::create_directories(folder); }
  ~Gl() override { fs::remove_all(folder); }

  void write(const char* name, const char* text) const { std::ofstream(folder / name) << text; }

  std::string error_of(const char* vertex, const char* fragment) const {
    try {
      const Program program(folder, vertex, fragment);
    } catch (const ShaderError& error) {
      return error.what();
    }
    return "";
  }

  HeadlessContext context;
  fs::path folder = fs::temp_directory_path() / ("sbcollide_gl_" + std::to_string(::getpid()));
};

constexpr const char* good_vertex = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n";
constexpr const char* good_fragment = "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n";

TEST_F(Gl, ShaderErrorNamesFileAndLine) {
  write("good.vert", good_vertex);
  write("bad.frag", "#version 330 core\nout vec4 c;\n\nvoid main() { c = nothing; }\n");
  const std::string message = error_of("good.vert", "bad.frag");
  EXPECT_TRUE(message.starts_with((folder / "bad.frag").string() + ":4")) << message;
}

TEST_F(Gl, ShaderErrorNamesTheIncludedFile) {
  write("good.vert", good_vertex);
  write("part.glsl", "float twice(float x) {\n  return 2.0 * y;\n}\n");
  write("main.frag", "#version 330 core\n#include \"part.glsl\"\nout vec4 c;\nvoid main() { c = vec4(twice(1.0)); }\n");
  const std::string message = error_of("good.vert", "main.frag");
  EXPECT_TRUE(message.starts_with((folder / "part.glsl").string() + ":2")) << message;
}

TEST_F(Gl, LinesAreCountedOnAfterAnInclude) {
  write("good.vert", good_vertex);
  write("part.glsl", "float one() {\n  return 1.0;\n}\n");
  write("main.frag", "#version 330 core\n#include \"part.glsl\"\nout vec4 c;\nvoid main() { c = wrong; }\n");
  const std::string message = error_of("good.vert", "main.frag");
  EXPECT_TRUE(message.starts_with((folder / "main.frag").string() + ":4")) << message;
}

TEST_F(Gl, MissingShaderIsNamed) {
  write("good.vert", good_vertex);
  EXPECT_NE(error_of("good.vert", "missing.frag").find("missing.frag"), std::string::npos);
}

TEST_F(Gl, LinkErrorNamesBothFiles) {
  write("two.vert", "#version 330 core\nout vec2 v;\nvoid main() { gl_Position = vec4(v = vec2(0.0), 0.0, 1.0); }\n");
  write("three.frag", "#version 330 core\nin vec3 v;\nout vec4 c;\nvoid main() { c = v.xyzz; }\n");
  const std::string message = error_of("two.vert", "three.frag");
  EXPECT_NE(message.find("two.vert"), std::string::npos) << message;
  EXPECT_NE(message.find("three.frag"), std::string::npos) << message;
}

TEST_F(Gl, GoodProgramLinks) {
  write("good.vert", good_vertex);
  write("good.frag", good_fragment);
  EXPECT_EQ(error_of("good.vert", "good.frag"), "");
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(Gl, FramebufferReadsRowsFromTheTop) {
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

TEST_F(Gl, SamplesAreCutDownToWhatIsPossible) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  EXPECT_EQ(Framebuffer({4, 4}, 1000).samples(), most);
  EXPECT_EQ(Framebuffer({4, 4}, 1).samples(), 0);
}

TEST_F(Gl, ImpossibleFramebufferSaysWhatIsPossible) {
  for (const glm::ivec2 size : {glm::ivec2(0, 10), glm::ivec2(10, -1), glm::ivec2(1 << 20, 10)}) {
    EXPECT_THROW(Framebuffer{size}, std::runtime_error);
  }
}

}  // namespace
}  // namespace engine
