#include "app/base/text.h"

#include <fmt/format.h>

namespace app {

std::string grouped(std::uint64_t number) { return fmt::format("{}", fmt::group_digits(number)); }

std::string ratio(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "-" : fmt::format("{:.3g}", static_cast<double>(part) / static_cast<double>(whole));
}

}  // namespace app
