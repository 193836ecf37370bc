#pragma once
// Adds options of the usual kinds.

#include <cassert>
#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

#include "app/base/parse_numbers.h"

namespace app::cli {

/// Accepts decimal numbers from min to max. CLI::Range would call a fraction out of range.
inline CLI::Validator integer_in_range(std::int64_t min, std::int64_t max) {
  assert(min <= max);
  const std::string from = std::to_string(min), to = std::to_string(max);
  return CLI::Validator(
      [=](std::string& text) {
        const auto number = parse_integer(text);
        if (!number || *number < min || *number > max)
          return "must be a whole number from " + from + " to " + to + ", not " + text;
        text = std::to_string(*number);  // CLI11 would read 010 as 8
        return std::string();
      },
      "INT in [" + from + " - " + to + "]");
}

/// Adds an option with a value of this type, as the help calls it.
template <class Value>
CLI::Option* add(CLI::App& command, const char* name, const char* type, Value& value, const std::string& text) {
  return command.add_option(name, value, text)->type_name(type);
}
/// Adds an option for a whole number from min to max.
template <class Value>
void add(CLI::App& command, const char* name, const char* type, std::int64_t min, std::int64_t max, Value& value,
         const std::string& text) {
  add(command, name, type, value, text)->transform(integer_in_range(min, max));
}

}  // namespace app::cli
