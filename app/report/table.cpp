#include "app/report/table.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/base/text.h"

namespace app {

std::string line(const Cells& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += fmt::format(" {} |", cell);
  return text + "\n";
}

std::string heading(const Cells& cells, std::size_t left) {
  std::string text = fmt::format("{}|", line(cells));
  for (std::size_t i = 0; i < cells.size(); ++i) text += i < left ? "---|" : "--:|";
  return text + "\n";
}

std::string brief(double value) {
  if (value >= 100) return whole(value);
  return value >= 10 ? fmt::format("{:.1f}", value) : fmt::format("{:#.3g}", value);
}

std::string whole(double value) { return grouped(static_cast<std::uint64_t>(std::llround(value))); }

std::string picture(const std::vector<Plot>& plots, std::string_view name) {
  const auto plot = std::ranges::find(plots, name, &Plot::name);
  return plot == plots.end() ? "" : fmt::format("\n![{}](<{}.svg>)\n", plot->caption, plot->name);
}

}  // namespace app
