#pragma once
// std::from_chars() for real numbers, which emscripten's standard library lacks. Included before every file.

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace std {

/// Reads the number at the start of a text, in decimal notation. musl's strtod() rounds correctly; what it accepts
/// beyond from_chars(), spaces, a + and hexadecimal numbers, is left out.
template <class Real, Real (*read)(const char*, char**)>
from_chars_result read_real(const char* first, const char* last, Real& value) {
  if (first == last) return {first, errc::invalid_argument};
  string text(first, last);
  const size_t digit = text.front() == '-';
  if (digit == text.size() || text[digit] == '+' || text[digit] == '-' ||
      isspace(static_cast<unsigned char>(text[digit])))
    return {first, errc::invalid_argument};
  text.resize(min(text.find_first_of("xX"), text.size()));
  char* end = nullptr;
  errno = 0;
  const Real number = read(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  const char* const at = first + (end - text.c_str());
  // It also tells of numbers that are too small for their full precision.
  if (errno == ERANGE && (number == 0 || isinf(number))) return {at, errc::result_out_of_range};
  value = number;
  return {at, errc()};
}

inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  return read_real<double, strtod>(first, last, value);
}
inline from_chars_result from_chars(const char* first, const char* last, float& value) {
  return read_real<float, strtof>(first, last, value);
}

}  // namespace std
