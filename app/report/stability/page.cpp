#include <cmath>
#include <map>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/report/stability/results.h"
#include "app/report/sums.h"

namespace app::report {

// ---- the table of figures ----

Table stability_table(const StabilityResults& results) {
  Table table;
  for (const StabilityRow& row : results.rows)
    for (const StabilityCell& cell : row.cells) {
      const reference::StabilityFigures& f = cell.figures;
      const bool ran = f.refused.empty(), compared = f.reference.has_value();
      const reference::ReferenceDeviation end = f.reference.value_or(reference::ReferenceDeviation{});
      table.add({{"part", "cell"},
                 {"case", row.key},
                 {"integrator", results.integrators[cell.integrator]->key},
                 {"dt", results.dts[cell.dt]},
                 {"stiffness", row.stiffness},
                 {"passes", cell.passes()},
                 {"failures", joined(reference::failures(f), "; ")},
                 {"not_judged", row.start.not_judged},
                 {"finite", when(ran, f.finite)},
                 {"energy_excess", when(ran, f.energy)},
                 {"speed_ratio", when(ran, f.speed)},
                 {"extent_ratio", when(ran, f.extent)},
                 {"transient_depth", when(ran, f.transient)},
                 {"steady_depth", when(ran, f.steady)},
                 {"through_solids", when(ran, f.passed_through)},
                 {"shape", when(compared, end.shape)},
                 {"volume", when(compared, end.volume)},
                 {"rest", when(compared, end.rest)},
                 {"blew_up", when(ran && f.blow_up_time > 0, f.blow_up_time)},
                 {"stable_step", ""},
                 {"predicted_step", ""}});
    }
  for (std::size_t i = 0; i < results.steps.size(); ++i)
    for (const StableStep& step : results.steps[i])
      table.add({{"part", "step"},
                 {"integrator", results.integrators[i]->key},
                 {"stiffness", step.stiffness},
                 {"stable_step", step.found},
                 {"predicted_step", when(std::isfinite(step.predicted), step.predicted)}});
  return table;
}

namespace {

// ---- plots ----

Plot step_against_stiffness(const Page& page, const StabilityResults& results) {
  Plot plot = page.plot_of("step against stiffness", "stability-steps", fmt::arg("tried", max_step_tried),
                           fmt::arg("top", 2 * max_step_tried));
  for (std::size_t i = 0; i < results.steps.size(); ++i) {
    Series found{std::string(results.integrators[i]->name), series_colour(i), "linespoints pointtype 7 linewidth 2"};
    Series predicted{"", series_colour(i), "lines dashtype 2 linewidth 1.5"};
    for (const StableStep& s : results.steps[i]) {
      found.points.push_back({s.stiffness, s.found});
      if (std::isfinite(s.predicted)) predicted.points.push_back({s.stiffness, s.predicted});
    }
    plot.add(std::move(found));
    plot.add(std::move(predicted));
  }
  return plot;
}

// ---- the page ----

/// Returns "1/60".
std::string fraction(double dt) { return fmt::format("1/{:.0f}", 1 / dt); }

/// Counts the cells that pass, by integrator and length of a frame.
Table overview(const StabilityResults& r) {
  Table table;
  for (std::size_t i = 0; i < r.integrators.size(); ++i) {
    std::vector<std::size_t> passed(r.dts.size() + 1), all(r.dts.size() + 1);  // by length of a frame; of all lengths
    for (const StabilityRow& row : r.rows)
      for (const StabilityCell& cell : row.cells)
        if (cell.integrator == i)
          for (const std::size_t column : {cell.dt, r.dts.size()}) passed[column] += cell.passes(), ++all[column];
    TableRow row{{"integrator", r.integrators[i]->name}};
    for (std::size_t c = 0; c < all.size(); ++c)
      row.push_back({c < r.dts.size() ? fraction(r.dts[c]) + " s" : "all", fmt::format("{} of {}", passed[c], all[c])});
    table.add(row);
  }
  return table;
}

/// Returns "ok", or the lengths of frames that fail.
std::string verdict(const StabilityResults& r, const StabilityRow& row, std::size_t integrator) {
  std::vector<std::string> failing;
  for (const StabilityCell& cell : row.cells)
    if (cell.integrator == integrator && !cell.passes()) failing.push_back(fraction(r.dts[cell.dt]));
  if (failing.empty()) return "ok";
  return failing.size() == r.dts.size() ? "fails" : fmt::format("fails {}", joined(failing, ", "));
}

/// Adds why stiffnesses are marked.
void add_marks(Page& page, std::span<const StabilityRow> rows) {
  std::map<std::string, std::vector<std::string>> marked;  // stiffnesses by reason
  for (const StabilityRow& row : rows)
    if (!row.start.not_judged.empty()) marked[row.start.not_judged].push_back(fmt::format("{:g}", row.stiffness));
  std::vector<std::string> reasons;
  for (const auto& [why, which] : marked) reasons.push_back(fmt::format("{}: {}", joined(which, ", "), why));
  if (!reasons.empty()) page.text("\\* {}.", joined(reasons, "; "));
}

/// Adds the rows of one case.
void add_case(Page& page, const StabilityResults& r, std::span<const StabilityRow> rows) {
  Table table;
  for (std::size_t i = 0; i < r.integrators.size(); ++i) {
    TableRow row{{"integrator", r.integrators[i]->name}};
    for (const StabilityRow& s : rows)
      row.push_back({fmt::format("{}{:g}{}{}", r.options.scene ? "x " : "", s.stiffness, r.options.scene ? "" : " N/m",
                                 s.start.not_judged.empty() ? "" : " *"),
                     verdict(r, s, i)});
    table.add(row);
  }
  page.text("### {}", rows.front().name);
  page.table(table, 1 + rows.size());
  add_marks(page, rows);
}

/// Adds what fails, in words, for the integrators that are meant to be stable at any step.
void add_failing_cells(Page& page, const StabilityResults& r) {
  Table table;
  for (const StabilityRow& row : r.rows)
    for (const StabilityCell& cell : row.cells) {
      const softbody::Integrator& integrator = *r.integrators[cell.integrator];
      if (cell.passes() || !integrator.stable_at_any_step()) continue;
      table.add({{"integrator", integrator.name},
                 {"case", row.name},
                 {"stiffness", fmt::format("{:g}", row.stiffness)},
                 {"dt, s", fraction(r.dts[cell.dt])},
                 {"what is wrong", joined(reference::failures(cell.figures), "; ")}});
    }
  if (table.empty()) return;
  page.add("failing");
  page.table(table, 5);
}

void add_steps(Page& page, const StabilityResults& r) {
  if (r.steps.empty()) return;
  const auto ms = [](double seconds) {
    return seconds >= max_step_tried ? fmt::format(">= {:g}", 1e3 * max_step_tried)
                                     : fmt::format("{:.3g}", 1e3 * seconds);
  };
  Table table;
  for (std::size_t i = 0; i < r.steps.size(); ++i) {
    TableRow row{{"integrator", r.integrators[i]->name}};
    for (const StableStep& s : r.steps[i])
      row.push_back({fmt::format("{:g} N/m", s.stiffness),
                     ms(s.found) + (std::isfinite(s.predicted) ? fmt::format(" ({})", ms(s.predicted)) : "")});
    table.add(row);
  }
  page.text("## Largest stable step, and its predicted bound, ms");
  page.table(table);
  page.plot(step_against_stiffness(page, r));
}

}  // namespace

Page stability_page(const StabilityResults& results) {
  Page page(results.options);
  constexpr reference::StabilityBounds b = reference::stability_bounds;
  page.introduce(fmt::arg("seconds", results.seconds),
                 fmt::arg("stiffnesses", page.text_of(results.options.scene ? "factors" : "springs")),
                 fmt::arg("energy", b.energy), fmt::arg("transient", b.transient), fmt::arg("steady", b.steady),
                 fmt::arg("shape", b.shape), fmt::arg("volume", 100 * b.volume), fmt::arg("rest", b.rest));
  page.text("## Cells that pass");
  page.table(overview(results));
  page.text("## Cases");
  for (const auto& rows : groups_of(results.rows, &StabilityRow::key)) add_case(page, results, rows);
  add_failing_cells(page, results);
  add_steps(page, results);
  return page;
}

}  // namespace app::report
