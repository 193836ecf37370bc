#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "app/base/text.h"
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

std::string percent(double share) {
  const bool short_enough = std::abs(share) < 0.995;  // else two digits would be 1e+02
  return short_enough ? fmt::format("{:.2g} %", 100 * share) : fmt::format("{:.0f} %", 100 * share);
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
               {"`auto`, largest error", percent(worst)}});
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
      cells.push_back({column, row == rows.end() ? ""
                               : !ran(*row)      ? row->failure
                                                 : percent(row->deviation()) + (row->failure.empty() ? "" : " *")});
    }
    table.add(cells);
  }
  return table;
}

/// Returns the errors of the case's first value against the steps in a second. Lines join runs of one variant.
Plot plot_of(const Page& page, std::span<const TheoryRow> rows) {
  constexpr std::array marks{std::pair(7, "circles"), std::pair(5, "squares"), std::pair(9, "triangles")};
  const TheoryCase& of = *rows.front().of;
  std::vector<std::string> variants;
  for (std::size_t v = 0; v < of.variants.size() && of.variants.size() > 1; ++v)
    variants.push_back(fmt::format("{}: {}", marks.at(v).second, of.variants[v]));
  Plot plot = page.plot_of("plot", "theory-" + of.key, fmt::arg("case", with_what(of.name, rows.front())),
                           fmt::arg("marks", variants.empty() ? "" : " (" + joined(variants, ", ") + ")"));
  for (const auto& runs : groups_of(rows, [](const TheoryRow& r) { return std::pair(r.integrator, r.variant); })) {
    const TheoryRow& first = runs.front();
    Series series{first.variant == 0 ? std::string(first.integrator->name) : "",
                  series_colour(std::size_t(first.integrator - softbody::integrators().data())),
                  fmt::format("linespoints pointtype {} linewidth 2", marks.at(std::size_t(first.variant)).first)};
    for (const TheoryRow& row : runs)
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
  page.add("all cases");
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
