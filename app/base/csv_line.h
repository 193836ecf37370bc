#pragma once
// CSV, RFC 4180 but for the line ends, which are "\n".

#include <string>
#include <string_view>

#include <fmt/core.h>

namespace app {

/// One line, field by field; ends with its life.
class CsvLine {
 public:
  explicit CsvLine(std::string& text) : text_(text) {}
  ~CsvLine() { text_ += '\n'; }
  CsvLine(const CsvLine&) = delete;
  CsvLine& operator=(const CsvLine&) = delete;

  void add(std::string_view field) {
    if (!first_) text_ += ',';
    first_ = false;
    if (field.find_first_of(",\"\r\n") == std::string_view::npos) {
      text_ += field;
      return;
    }
    text_ += '"';
    for (const char c : field) text_.append(c == '"' ? 2 : 1, c);
    text_ += '"';
  }
  void add(double number) { add(std::string_view(fmt::format("{:.9g}", number))); }
  /// Adds the number, or an empty field if it is not known.
  void add_if(bool known, double number) { known ? add(number) : add(std::string_view()); }

 private:
  std::string& text_;
  bool first_ = true;
};

}  // namespace app
