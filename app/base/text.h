#pragma once
// Numbers and errors as text.

#include <cstdint>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

namespace app {

/// Returns "1,234,567".
std::string grouped(std::uint64_t number);

/// Returns `part` / `whole` in three digits; "-" if `whole` is 0.
std::string ratio(std::uint64_t part, std::uint64_t whole);

/// Returns what went wrong, for the user.
std::string failure_text(const std::exception& error);

/// Returns the texts with a separator between them.
std::string joined(const std::vector<std::string>& texts, std::string_view separator);

}  // namespace app
