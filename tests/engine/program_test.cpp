#include "engine/program.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "engine/resources.h"
#include "tests/engine/drawing_context.h"
#include "tests/temporary_folder.h"

namespace engine {
namespace THIS_FILE {

class ProgramTest : public testing::Test {
 protected:
  std::filesystem::path write(const char* name, const char* text) const { return folder.write(name, text); }

  /// Returns the message of the error that these shaders cause; empty if there is none.
  std::string error_of(const char* vertex, const char* fragment) const {
    try {
      const Program program(folder.path(), vertex, fragment);
    } catch (const ShaderError& error) {
      return error.what();
    }
    return "";
  }

  DrawingContext context;
  tests::TemporaryFolder folder;
};

constexpr const char* correct_vertex = "void main() { gl_Position = vec4(0.0); }\n";
constexpr const char* correct_fragment = "out vec4 c;\nvoid main() { c = vec4(1.0); }\n";

TEST_F(ProgramTest, ErrorNamesFileAndLineAlsoInAndAfterAnIncludedFile) {
  write("correct.vert", correct_vertex);
  write("correct.glsl", "float one() {\n  return 1.0;\n}\n");
  write("bad.glsl", "float twice(float x) {\n  return 2.0 * y;\n}\n");
  const std::string head = "// a comment\nout vec4 c;\n";
  for (const auto& [rest, place] : {std::pair{"\nvoid main() { c = nothing; }\n", "main.frag:4"},
                                    {"#include \"bad.glsl\"\nvoid main() { c = vec4(twice(1.0)); }\n", "bad.glsl:2"},
                                    {"#include \"correct.glsl\"\nvoid main() { c = wrong; }\n", "main.frag:4"}}) {
    folder.write("main.frag", head + rest);
    const std::string message = error_of("correct.vert", "main.frag");
    EXPECT_TRUE(message.starts_with((folder.path() / place).string())) << message;
  }
}

TEST_F(ProgramTest, ErrorNamesAMissingFile) {
  write("correct.vert", correct_vertex);
  EXPECT_NE(error_of("correct.vert", "missing.frag").find("missing.frag"), std::string::npos);
}

TEST_F(ProgramTest, LinkErrorNamesBothFiles) {
  write("two.vert", "out vec2 v;\nvoid main() { gl_Position = vec4(v = vec2(0.0), 0.0, 1.0); }\n");
  write("three.frag", "in vec3 v;\nout vec4 c;\nvoid main() { c = v.xyzz; }\n");
  const std::string message = error_of("two.vert", "three.frag");
  EXPECT_NE(message.find("two.vert"), std::string::npos) << message;
  EXPECT_NE(message.find("three.frag"), std::string::npos) << message;
}

TEST_F(ProgramTest, LinksCorrectShaders) {
  write("correct.vert", correct_vertex);
  write("correct.frag", correct_fragment);
  EXPECT_EQ(error_of("correct.vert", "correct.frag"), "");
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

// The reference compiler is stricter than drivers are.
TEST(ShaderText, IsValidForOpenGl33AndForWebGl2) {
  if (std::system("command -v glslangValidator >/dev/null") != 0) GTEST_SKIP() << "no glslangValidator";
  for (const char* version : {"#version 330 core", "#version 300 es"}) {
    const tests::TemporaryFolder folder;
    std::string command = "cd " + folder.path().string() + " && glslangValidator";
    for (const auto& entry : std::filesystem::directory_iterator(find_folder("shaders"))) {
      if (entry.path().extension() == ".glsl") continue;
      const std::string name = entry.path().filename();
      folder.write(name, shader_text(entry.path(), version));
      command += " " + name;
    }
    EXPECT_EQ(std::system(command.c_str()), 0) << version;
  }
}

}  // namespace THIS_FILE
}  // namespace engine
