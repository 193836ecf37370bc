#pragma once
// Numbers as text.

#include <cstdint>
#include <string>

namespace app {

/// Returns "1,234,567".
std::string grouped(std::uint64_t number);

/// Returns `part` / `whole` in three digits; "-" if `whole` is 0.
std::string ratio(std::uint64_t part, std::uint64_t whole);

}  // namespace app
