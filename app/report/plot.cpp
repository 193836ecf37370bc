#include "app/report/plot.h"

#include <cmath>

#include <fmt/core.h>

namespace app {

std::string literal(std::string_view text) {
  std::string result = "'";
  for (const char c : text) result.append(c == '\'' ? 2 : 1, c);
  return result + "'";
}

std::string colour(const collide::Method& method) {
  const auto byte = [](float part) { return static_cast<int>(std::lround(255 * part)); };
  return fmt::format("'#{:02x}{:02x}{:02x}'", byte(method.colour.r), byte(method.colour.g), byte(method.colour.b));
}

}  // namespace app
