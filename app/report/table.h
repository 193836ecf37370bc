#pragma once
// The pieces that the report's Markdown is made of.

#include <string>
#include <vector>

#include "app/base/text.h"
#include "app/report/plot.h"

namespace app {

using Cells = std::vector<std::string>;

/// A row of a table.
std::string line(const Cells& cells);
/// The names of the columns and what aligns them: the first `left` hold text, the others numbers.
std::string heading(const Cells& cells, std::size_t left);

/// Three digits that count: "0.0123", "12.3", "1,234".
std::string brief(double value);
/// "1,234"
std::string whole(double value);

/// The plot of that name, if it is there.
std::string picture(const std::vector<Plot>& plots, std::string_view name);

}  // namespace app
