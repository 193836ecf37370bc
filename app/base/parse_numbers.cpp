#include "app/base/parse_numbers.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>

#include "softbody/mesh/read_number.h"

namespace app {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == text.npos) return parts;
    text.remove_prefix(end + 1);
  }
}

namespace {

template <class Number>
std::optional<Number> read(std::string_view text) {
  Number number{};
  const auto [end, error] = softbody::read_number(text, number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::optional<std::int64_t> parse_integer(std::string_view text) { return read<std::int64_t>(text); }

std::optional<std::vector<double>> parse_reals(std::string_view text, char separator) {
  std::vector<double> numbers;
  for (const std::string_view part : split(text, separator)) {
    const auto number = read<double>(part);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<double> parse_typed(std::string_view text, bool whole) {
  constexpr std::string_view blank = " \t";
  text.remove_prefix(std::min(text.find_first_not_of(blank), text.size()));
  text = text.substr(0, text.find_last_not_of(blank) + 1);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  if (whole && text.find_first_of(",.eE") != text.npos) return std::nullopt;
  std::string number(text);
  std::ranges::replace(number, ',', '.');
  const auto value = read<double>(number);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace app
