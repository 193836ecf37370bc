#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/report/sums.h"
#include "app/report/theory/results.h"

namespace app::report {
namespace {

/// Returns "own steps, 162 vertices".
std::string setting_of(const TheoryRow& row) {
  const std::string& variant = row.of->variants[std::size_t(row.variant)];
  return (row.finer == 1 ? "own steps" : fmt::format("{} x own steps", row.finer)) +
         (variant.empty() ? "" : ", " + variant);
}
std::string with_what(std::string text, const TheoryRow& row) {
  return row.what.empty() ? text : text + ", " + row.what;
}
std::string name_of(const TheoryRow& row) { return with_what(std::string(row.integrator->name), row); }
bool ran(const TheoryRow& row) { return row.rate > 0; }

std::string percent(const TheoryRow& row) {
  return fmt::format("{:.2g} %{}", 100 * row.deviation(), row.failure.empty() ? "" : " *");
}

}  // namespace

Table theory_table(const std::vector<TheoryRow>& rows) {
  Table table;
  for (const TheoryRow& row : rows)
    table.add({{"case", row.of->key},
               {"integrator", row.integrator->key},
               {"setting", with_what(setting_of(row), row)},
               {"theory", when(ran(row), row.theory)},
               {"measured", when(ran(row), row.measured)},
               {"error", when(ran(row), row.deviation())},
               {"ms", when(ran(row), row.ms)}});
  return table;
}

namespace {

/// Returns how many comparisons of each case are within their bounds, and how near `auto` comes with its own steps.
Table overview(const std::vector<std::span<const TheoryRow>>& cases) {
  Table table;
  for (const auto& rows : cases) {
    double worst = 0;
    for (const TheoryRow& row : rows)
      if (ran(row) && row.integrator->automatic) worst = std::max(worst, std::abs(row.deviation()));
    table.add({{"case", rows.front().of->name},
               {"within bounds", fmt::format("{} of {}", std::ranges::count(rows, "", &TheoryRow::failure),
                                             std::ranges::count_if(rows, ran))},
               {"`auto`, largest error", fmt::format("{:.2g} %", 100 * worst)}});
  }
  return table;
}

/// Returns the errors of a case: a row for each integrator and value, a column for each setting.
Table errors(std::span<const TheoryRow> rows) {
  std::vector<std::string> columns, names;
  const auto add_new = [](std::vector<std::string>& list, const std::string& text) {
    if (std::ranges::count(list, text) == 0) list.push_back(text);
  };
  for (const TheoryRow& row : rows) add_new(columns, setting_of(row)), add_new(names, name_of(row));
  Table table;
  for (const std::string& name : names) {
    TableRow cells{{"integrator", name}};
    for (const std::string& column : columns) {
      const auto row =
          std::ranges::find_if(rows, [&](const TheoryRow& r) { return name_of(r) == name && setting_of(r) == column; });
      cells.push_back({column, row == rows.end() ? "" : ran(*row) ? percent(*row) : row->failure});
    }
    table.add(cells);
  }
  return table;
}

/// Returns the errors against the steps in a second.
Plot plot_of(const Page& page, std::span<const TheoryRow> rows) {
  Plot plot = page.plot_of("plot", "theory-" + rows.front().of->key, fmt::arg("case", rows.front().of->name));
  const std::vector<TheoryRow> all(rows.begin(), rows.end());
  for (const auto& of_one : groups_of(all, &TheoryRow::integrator)) {
    Series series{std::string(of_one.front().integrator->name), series_colour(plot.series.size()),
                  "linespoints pointtype 7 linewidth 2"};
    for (const TheoryRow& row : of_one)
      if (ran(row) && row.what == rows.front().what)
        series.points.push_back({row.rate, std::max(std::abs(row.deviation()), 1e-9)});
    plot.add(std::move(series));
  }
  return plot;
}

}  // namespace

Page theory_page(const ReportOptions& options, const std::vector<TheoryRow>& rows) {
  Page page(options);
  page.introduce();
  const auto cases = groups_of(rows, &TheoryRow::of);
  page.text("## All cases");
  page.table(overview(cases));
  for (const auto& of_one : cases) {
    page.text("## {}", of_one.front().of->name);
    page.add(of_one.front().of->key);
    page.table(errors(of_one));
    page.plot(plot_of(page, of_one));
  }
  return page;
}

}  // namespace app::report
