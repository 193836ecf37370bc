#pragma once
// The pieces that the report's Markdown is made of.

#include <string>
#include <vector>

#include "app/report_plots.h"
#include "app/report_text.h"

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

// A setting, or nothing where the method has no use for it.
std::string levels_of(const Configuration& c);
std::string buckets_of(const Configuration& c);
std::string cell_of(const Configuration& c);

/// The plot of that name, if it is there.
std::string picture(const std::vector<Plot>& plots, std::string_view name);

}  // namespace app
