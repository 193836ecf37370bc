#pragma once
// Composes lines of tables of comma-separated values. It uses to_chars, because a table may have millions of lines.

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

namespace app::files {

class CsvLine {
 public:
  /// Appends a field and the character after it.
  template <class Number>
  void add(Number number, char after) {
    end_ = std::to_chars(end_, text_.end(), number).ptr;  // of a real number, the fewest digits that identify it
    *end_++ = after;
  }
  /// Appends a real number with nine digits, which identify a float.
  void add_float(float number, char after) {
    end_ = std::to_chars(end_, text_.end(), double{number}, std::chars_format::general, 9).ptr;
    *end_++ = after;
  }
  void add_text(std::string_view text, char after) {
    end_ = std::copy(text.begin(), text.end(), end_);
    *end_++ = after;
  }
  std::string_view text() const { return {text_.data(), static_cast<std::size_t>(end_ - text_.data())}; }

 private:
  std::array<char, 160> text_;  // at most five integers of 20 digits and two real numbers of 24 characters
  char* end_ = text_.data();
};

}  // namespace app::files
