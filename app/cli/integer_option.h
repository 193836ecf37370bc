#pragma once
// Options whose values are whole numbers.

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

#include "app/base/parse_numbers.h"

namespace app {

/// Decimal. In place of CLI::Range, which says of a fraction that it is out of range.
inline CLI::Validator integer_in_range(std::int64_t least, std::int64_t most) {
  const std::string from = std::to_string(least), to = std::to_string(most);
  return CLI::Validator(
      [=](std::string& text) {
        const auto number = parse_integer(text);
        if (!number || *number < least || *number > most)
          return "must be a whole number from " + from + " to " + to + ", not " + text;
        text = std::to_string(*number);  // CLI11 would read 010 as 8
        return std::string();
      },
      "INT in [" + from + " - " + to + "]");
}

}  // namespace app
