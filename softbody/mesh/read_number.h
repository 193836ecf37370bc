#pragma once

#include <charconv>
#include <string_view>

namespace softbody {

/// Reads the number at the start of a text as std::from_chars() does. The only place that calls it for real numbers,
/// which some standard libraries cannot read by it.
inline std::from_chars_result read_number(std::string_view text, auto& number) {
  return std::from_chars(text.data(), text.data() + text.size(), number);
}

}  // namespace softbody
