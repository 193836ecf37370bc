#include "softbody/scene/toml_text.h"

#include <array>
#include <cstdio>

namespace softbody {
namespace {

std::string list(const auto& vector) {
  std::string text = "[";
  for (int k = 0; k < 3; ++k) text.append(k > 0 ? ", " : "").append(toml_value(vector[k]));
  return text + "]";
}

}  // namespace

std::string toml_value(const glm::dvec3& value) { return list(value); }
std::string toml_value(const glm::vec3& value) { return list(value); }
std::string toml_value(const glm::dmat3& value) { return list(value); }

std::string toml_value(std::string_view value) {
  std::string text = "\"";
  for (const char c : value) {
    std::array<char, 8> code;
    if (c == '"' || c == '\\') {
      text.append(1, '\\').append(1, c);
    } else if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') {
      std::snprintf(code.data(), code.size(), "\\u%04X", static_cast<unsigned>(c));
      text += code.data();
    } else {
      text += c;
    }
  }
  return text + '"';
}

}  // namespace softbody
