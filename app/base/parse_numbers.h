#pragma once
// Reads numbers that the user gave. Those of the command line it reads strictly: no space, no plus sign, nothing before
// or after.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace app {

/// Returns the parts between separators: "1,,2," has four, two of them empty.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Returns nothing if the text is not a whole number, or does not fit.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Returns the numbers between separators; nothing unless all parts are numbers within a double's range.
std::optional<std::vector<double>> parse_reals(std::string_view text, char separator);

/// Returns the finite number typed into a field; nothing if the text is none. A comma is a decimal point. Spaces around
/// the number and a plus sign are allowed. If `whole`, only digits are.
std::optional<double> parse_typed(std::string_view text, bool whole);

}  // namespace app
