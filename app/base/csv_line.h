#pragma once
// CSV as in RFC 4180, except that lines end with "\n".

#include <cstdint>
#include <string>
#include <string_view>

#include "app/base/text.h"

namespace app {

/// Appends one line to a text, field by field. The destructor ends the line.
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
  void add(double number) { add(std::string_view(format("%.9g", number))); }
  void add(std::uint64_t number) { add(std::string_view(std::to_string(number))); }
  /// Adds the number if it is known, else an empty field.
  template <class Number>
  void add_if(bool known, Number number) {
    known ? add(number) : add(std::string_view());
  }

 private:
  std::string& text_;
  bool first_ = true;
};

}  // namespace app
