#pragma once
// Composes texts.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace app {

/// Like snprintf, for at most 255 characters.
template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

/// Of two counts; "-" if the second is none.
inline std::string ratio(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "-" : format("%.3g", static_cast<double>(part) / static_cast<double>(whole));
}

template <class... Parts>
std::string joined(const Parts&... parts) {
  std::string text;
  (text.append(std::string_view(parts)), ...);
  return text;
}

/// Returns the number with its digits in groups of three, e.g. "1,234,567".
inline std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3) {
    text.insert(static_cast<std::size_t>(at), 1, ',');
  }
  return text;
}

}  // namespace app
