#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/report/solver/results.h"

namespace app {
namespace {

/// Returns the height (R) of the crosses of curve `number`. Each curve has a row above all errors, so that crosses do
/// not hide each other.
double cross_height(std::size_t number) { return 20 * std::pow(1.6, static_cast<double>(number)); }

void add_errors(Plot& plot, const WorkCurve& curve, std::size_t number, std::optional<double> order) {
  // The single point of an integrator that chooses its steps lies under others' curves: a large open diamond shows
  // around them.
  const bool automatic = curve.integrator->automatic;
  Series series{fmt::format("{}{}", curve.integrator->name, order ? fmt::format(" (order {:.1f})", *order) : ""),
                integrator_colour(number),
                automatic ? "points pointtype 12 pointsize 2.2 linewidth 2"
                          : "linespoints pointtype 7 pointsize 0.8 linewidth 2"};
  for (const WorkPoint& p : curve.points)
    if (!p.blew_up) series.points.push_back({p.cost(), std::max(p.error, 1e-9), automatic ? "" : steps_text(p)});
  plot.add(std::move(series));
}

void add_crosses(Plot& plot, const WorkCurve& curve, std::size_t number) {
  // Runs that blow up end early: they would have cost what their steps cost elsewhere on the curve.
  const auto good = std::ranges::find(curve.points, false, &WorkPoint::blew_up);
  const bool known = good != curve.points.end() && good->substeps > 0;
  Series series{"", integrator_colour(number), "points pointtype 2 pointsize 1 linewidth 2"};
  for (const WorkPoint& p : curve.points)
    if (p.blew_up)
      series.points.push_back({known ? good->cost() * p.substeps / good->substeps : p.cpu_alone, cross_height(number)});
  plot.add(std::move(series));
}

}  // namespace

Plot error_against_time(const SolverCase& c, double bound) {
  Plot plot{.name = "solver-" + c.key,
            .caption = c.name + ": left is cheaper, down is more accurate; numbers are steps a frame, crosses blew up.",
            .title = fmt::format("{}: error against run time (a disturbance grows {:.3g} times)", c.name, c.growth),
            .x = "processor time, ms a simulated second a body",
            .y = "error in position, RMS / R",
            .settings = fmt::format("set yrange [*:{0:g}]\n"
                                    "set ytics 1e-9, 10, 10 format '%g'\n"
                                    "set label 'blew up:' at graph 0.01, graph 0.97\n"
                                    "set arrow from graph 0, first {1:g} to graph 1, first {1:g} nohead dashtype 2 "
                                    "linecolor rgb '#666666'\n"
                                    "set label 'uncertainty of the reference' at graph 0.01, first {1:g} offset 0,0.5 "
                                    "font ',8' textcolor rgb '#666666'\n",
                                    cross_height(c.curves.size()), c.uncertainty(bound))};
  for (std::size_t i = 0; i < c.curves.size(); ++i) add_errors(plot, c.curves[i], i, c.order(c.curves[i], bound));
  for (std::size_t i = 0; i < c.curves.size(); ++i) add_crosses(plot, c.curves[i], i);
  return plot;
}

}  // namespace app
