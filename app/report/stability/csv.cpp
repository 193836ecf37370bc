#include <cmath>

#include <fmt/core.h>

#include "app/base/csv_line.h"
#include "app/report/stability/results.h"

namespace app {
namespace {

void add_header(std::string& text) {
  CsvLine line(text);
  for (const char* name : {"part",
                           "case",
                           "integrator",
                           "dt",
                           "stiffness",
                           "passes",
                           "failures",
                           "not_judged",
                           "finite",
                           "energy_excess",
                           "speed_ratio",
                           "extent_ratio",
                           "transient_depth",
                           "steady_depth",
                           "through_solids",
                           "shape",
                           "volume",
                           "rest",
                           "blew_up",
                           "stable_step",
                           "predicted_step"})
    line.add(std::string_view(name));
}

void add_figures(CsvLine& line, const StabilityFigures& f) {
  const bool ran = f.refused.empty();
  line.add_if(ran, static_cast<std::uint64_t>(f.finite));
  for (const double value : {f.energy, f.speed, f.extent, f.transient, f.steady}) line.add_if(ran, value);
  line.add_if(ran, static_cast<std::uint64_t>(f.through));
  const AgainstReference r = f.reference.value_or(AgainstReference{});
  for (const double value : {r.shape, r.volume, r.rest}) line.add_if(f.reference.has_value(), value);
  line.add_if(ran && f.blew_up > 0, f.blew_up);
}

void add_cell(std::string& text, const StabilityResults& results, const StabilitySection& section,
              const StabilityRow& row, const StabilityCell& cell) {
  CsvLine line(text);
  line.add(std::string_view("cell"));
  line.add(section.key);
  line.add(results.integrators[cell.integrator]->key);
  line.add(results.dts[cell.dt]);
  line.add(row.stiffness);
  line.add(static_cast<std::uint64_t>(cell.passes()));
  std::string why;
  for (const std::string& f : failures(cell.figures)) why += fmt::format("{}{}", why.empty() ? "" : "; ", f);
  line.add(why);
  line.add(row.untold);
  add_figures(line, cell.figures);
  line.add(std::string_view());
  line.add(std::string_view());
}

void add_step(std::string& text, std::string_view integrator, const StableStep& step) {
  CsvLine line(text);
  line.add(std::string_view("step"));
  line.add(std::string_view());
  line.add(integrator);
  line.add(std::string_view());
  line.add(step.stiffness);
  for (int i = 0; i < 14; ++i) line.add(std::string_view());
  line.add(step.found);
  line.add_if(std::isfinite(step.predicted), step.predicted);
}

}  // namespace

std::string stability_csv(const StabilityResults& results) {
  std::string text;
  add_header(text);
  for (const StabilitySection& section : results.sections)
    for (const StabilityRow& row : section.rows)
      for (const StabilityCell& cell : row.cells) add_cell(text, results, section, row, cell);
  for (std::size_t i = 0; i < results.steps.size(); ++i)
    for (const StableStep& step : results.steps[i]) add_step(text, results.integrators[i]->key, step);
  return text;
}

}  // namespace app
