#pragma once
// Writing TOML: values as text that reads back to the same bits, and lines of it.

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace softbody {

// The shortest text that stands for the value. Numbers must be finite. Text may hold anything that is UTF-8.
std::string toml_value(double value);
std::string toml_value(float value);  // shortest for a float: 0.1, not 0.10000000149
std::string toml_value(std::int64_t value);
std::string toml_value(bool value);
std::string toml_value(std::string_view value);
std::string toml_value(const glm::dvec3& value);
std::string toml_value(const glm::vec3& value);
std::string toml_value(const glm::dmat3& value);  // its columns
std::string toml_value(std::integral auto value) { return toml_value(static_cast<std::int64_t>(value)); }
inline std::string toml_value(const char* value) { return toml_value(std::string_view(value)); }
inline std::string toml_value(const std::string& value) { return toml_value(std::string_view(value)); }

/// The lines of a file; add() and the like return the object, so that they chain.
class TomlLines {
 public:
  /// key = value
  TomlLines& add(std::string_view key, const auto& value) { return put(key, toml_value(value)); }
  /// An inline table: {a = 1, b = 2}
  TomlLines& add(std::string_view key, const class TomlInline& table);
  /// An empty line, and the heading of a table: [ground] or [[body]], as given.
  TomlLines& heading(std::string_view text);
  const std::string& text() const { return text_; }

 private:
  TomlLines& put(std::string_view key, const std::string& value);
  std::string text_;
};

class TomlInline {
 public:
  TomlInline& add(std::string_view key, const auto& value) { return put(key, toml_value(value)); }
  std::string text() const { return "{" + text_ + "}"; }

 private:
  TomlInline& put(std::string_view key, const std::string& value);
  std::string text_;
};

}  // namespace softbody
