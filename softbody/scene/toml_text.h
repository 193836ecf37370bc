#pragma once
// Writes TOML: values as text that reads back to the same bits, and lines of them.

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "softbody/mesh/shortest_text.h"

namespace softbody {

// Return the shortest text that stands for the value. Numbers must be finite. Text may be any UTF-8.
inline std::string toml_value(bool value) { return value ? "true" : "false"; }
template <class Number>
requires std::is_arithmetic_v<Number> std::string toml_value(Number value) {  // of a float: 0.1, not 0.10000000149
  return shortest_text(value);
}
std::string toml_value(std::string_view value);
std::string toml_value(const glm::dvec3& value);
std::string toml_value(const glm::vec3& value);
std::string toml_value(const glm::dmat3& value);  // by columns
inline std::string toml_value(const char* value) { return toml_value(std::string_view(value)); }

template <class Value>
std::string toml_value(const std::vector<Value>& values) {
  std::string text;
  for (const Value& value : values) text.append(text.empty() ? "" : ", ").append(toml_value(value));
  return "[" + text + "]";
}

/// Builds the inside of an inline table: {a = 1, b = 2}. add() returns the object, so that calls can be chained.
class TomlInline {
 public:
  TomlInline& add(std::string_view key, const auto& value) {
    text_.append(text_.empty() ? "" : ", ").append(key).append(" = ").append(toml_value(value));
    return *this;
  }
  friend std::string toml_value(const TomlInline& table) { return "{" + table.text_ + "}"; }

 private:
  std::string text_;
};

/// Builds the lines of a file. add() and heading() return the object, so that calls can be chained.
class TomlLines {
 public:
  /// Adds a line `key = value`.
  TomlLines& add(std::string_view key, const auto& value) {
    text_.append(key).append(" = ").append(toml_value(value)).append(1, '\n');
    return *this;
  }
  /// Adds an empty line and the heading of a table, which is given with its brackets: [ground] or [[body]].
  TomlLines& heading(std::string_view text) {
    text_.append(text_.empty() ? "" : "\n").append(text).append(1, '\n');
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace softbody
