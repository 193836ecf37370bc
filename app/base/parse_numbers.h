#pragma once
// Numbers as the command line writes them, taken strictly: no space, no plus sign, nothing before or after.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace app {

/// The parts between separators: "1,,2," has four, two of them empty.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Nothing if the text is no whole number, or one that does not fit.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Nothing if the text is no number, or not within a double's range.
std::optional<double> parse_real(std::string_view text);

/// Those that separators stand between; nothing unless all are numbers.
std::optional<std::vector<double>> parse_reals(std::string_view text, char separator);

}  // namespace app
