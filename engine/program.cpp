#include "engine/program.h"

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <vector>

#include "engine/context.h"

namespace engine {
namespace fs = std::filesystem;

namespace {

/// The text of a shader with its includes, and the file and line that each line comes from. (#line is no alternative:
/// drivers interpret it differently, and Mesa confuses the files.)
struct ShaderSource {
  struct Origin {
    fs::path file;
    int line;
  };
  std::string text;
  std::vector<Origin> lines;
};

void append_file(ShaderSource& source, const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw ShaderError(file.string() + ": cannot read this shader");
  std::string line;
  for (int n = 1; std::getline(stream, line); ++n) {
    if (line.starts_with("#include \"")) {
      const std::size_t name = line.find('"') + 1;
      append_file(source, file.parent_path() / line.substr(name, line.rfind('"') - name));
    } else {
      source.text += line + "\n";
      source.lines.push_back({file, n});
    }
  }
}

// In OpenGL ES, not every type has a default precision.
constexpr const char* default_precisions =
    "#ifdef GL_ES\n"
    "precision highp float;\n"
    "precision highp int;\n"
    "precision highp sampler2D;\n"
    "precision highp sampler2DShadow;\n"
    "#endif\n";

ShaderSource read_source(const fs::path& file, const std::string& version) {
  ShaderSource source{version + "\n" + default_precisions, {}};
  source.lines.assign(static_cast<std::size_t>(std::ranges::count(source.text, '\n')), {file, 1});
  append_file(source, file);
  return source;
}

template <class Get, class GetLog>
std::string info_log(GLuint name, Get get, GetLog get_log) {
  GLint length = 0;
  get(name, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  get_log(name, length, nullptr, log.data());
  return log.c_str();
}

/// Replaces the line number at the start of each of the driver's messages by file and line. Mesa writes "0:12(5): ",
/// NVIDIA "0(12) : ", others "ERROR: 0:12: ".
std::string with_file_and_line(const std::string& log, const ShaderSource& source) {
  std::istringstream lines(log);
  std::string result, line;
  while (std::getline(lines, line)) {
    const std::size_t start = line.starts_with("ERROR: ") ? 7 : 0;
    std::size_t number = 0;
    if (!result.empty()) result += "\n";
    if (std::sscanf(line.c_str() + start, "%*d%*1[:(]%zu", &number) == 1 && number - 1 < source.lines.size()) {
      const ShaderSource::Origin& origin = source.lines[number - 1];
      const std::size_t text = line.find(": ", start);
      result += origin.file.string() + ":" + std::to_string(origin.line) + line.substr(std::min(text, line.size()));
    } else {
      result += line;
    }
  }
  return result;
}

using ShaderName = GlName<detail::delete_shader>;

/// Compiles a shader and attaches it to `program`. Throws ShaderError.
ShaderName compile(GLuint program, GLenum stage, const fs::path& file) {
  const ShaderSource source = read_source(file, glsl_version());
  ShaderName name(glCreateShader(stage));
  const GLuint shader = name.get();
  const char* text = source.text.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
  GLint ok = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (!ok) throw ShaderError(with_file_and_line(info_log(shader, glGetShaderiv, glGetShaderInfoLog), source));
  return name;
}

[[maybe_unused]] GLuint current_program() {
  GLint name = 0;
  glGetIntegerv(GL_CURRENT_PROGRAM, &name);
  return static_cast<GLuint>(name);
}

}  // namespace

std::string shader_text(const fs::path& file, const std::string& version) { return read_source(file, version).text; }

Program::Program(const fs::path& folder, const std::string& vertex_file, const std::string& fragment_file)
    : name_(glCreateProgram()) {
  const GLuint program = name_.get();
  const ShaderName vertex = compile(program, GL_VERTEX_SHADER, folder / vertex_file);
  const ShaderName fragment = compile(program, GL_FRAGMENT_SHADER, folder / fragment_file);
  glLinkProgram(program);
  glDetachShader(program, vertex.get());
  glDetachShader(program, fragment.get());
  GLint ok = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &ok);
  if (!ok) {
    throw ShaderError((folder / vertex_file).string() + " with " + fragment_file + ": " +
                      info_log(program, glGetProgramiv, glGetProgramInfoLog));
  }
  const GLuint block = glGetUniformBlockIndex(program, "Frame");
  if (block != GL_INVALID_INDEX) glUniformBlockBinding(program, block, 0);
}

GLint Program::location(const char* name) const {
  assert(current_program() == name_.get());
  return glGetUniformLocation(name_.get(), name);
}

}  // namespace engine
