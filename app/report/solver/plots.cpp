#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/report/integrator_colours.h"
#include "app/report/solver/results.h"

namespace app {
namespace {

/// A full batch's, where there is one.
double cost(const WorkPoint& p) { return p.cpu_batch.value_or(p.cpu_alone); }

class Diagram {
 public:
  /// bound: R, of the references' change.
  Diagram(const SolverCase& c, double bound) {
    const double known = c.known(bound);
    script = fmt::format(
        "{}set title {}\nset yrange [*:{:g}]\nset ytics 1e-9, 10, 10 format '%g'\nset label 'blew up:' at graph 0.01, "
        "graph 0.97\nset xlabel 'processor time, ms a simulated second a body'\nset ylabel 'error in position, RMS / "
        "R'\n",
        plot_style,
        literal(fmt::format("{}: error against run time (a disturbance grows {:.3g} times)", c.name, c.growth)),
        row(c.curves.size()));
    script += fmt::format(
        "set arrow from graph 0, first {:g} to graph 1, first {:g} nohead dashtype 2 linecolor rgb '#666666'\nset "
        "label 'uncertainty of the reference' at graph 0.01, first {:g} offset 0,0.5 font ',8' textcolor rgb "
        "'#666666'\n",
        known, known, known);
    for (std::size_t i = 0; i < c.curves.size(); ++i) add(c.curves[i], i, c.order(c.curves[i], bound));
    for (std::size_t i = 0; i < c.curves.size(); ++i) add_crosses(c.curves[i], i);
  }

  std::string finished() const { return plot_.empty() ? "" : fmt::format("{}{}\n", script, plot_); }

 private:
  /// Above the errors, a row a method, so that crosses do not lie upon each other.
  static double row(std::size_t number) { return 20 * std::pow(1.6, double(number)); }  // R

  void add(const WorkCurve& curve, std::size_t number, std::optional<double> order) {
    std::string good;
    bool chooses = false;
    for (const WorkPoint& p : curve.points) {
      if (p.blew_up) continue;
      good += fmt::format("{:.9g} {:.9g} {}\n", cost(p), std::max(p.error, 1e-9), steps_text(p));
      chooses = p.substeps == 0;
    }
    if (good.empty()) return;
    const char* colour = integrator_colour(number);
    script += fmt::format("$g{} << EOD\n{}EOD\n", number, good);
    // A single point under others' curves: a large open diamond shows around them.
    const char* style = chooses ? "points pointtype 12 pointsize 2.2" : "linespoints pointtype 7 pointsize 0.8";
    plot_ += fmt::format(
        "{}$g{} with {} linewidth 2 linecolor rgb '{}' title {}", separator(), number, style, colour,
        literal(fmt::format("{}{}", curve.integrator->name, order ? fmt::format(" (order {:.1f})", *order) : "")));
    if (!chooses)
      plot_ += fmt::format(", $g{} using 1:2:3 with labels offset 0.9,0.5 font ',8' textcolor rgb '{}' notitle", number,
                           colour);
  }

  void add_crosses(const WorkCurve& curve, std::size_t number) {
    // Runs that blow up end early: they would have cost what their steps cost elsewhere on the curve.
    const auto good = std::ranges::find(curve.points, false, &WorkPoint::blew_up);
    std::string crosses;
    for (const WorkPoint& p : curve.points) {
      const double whole =
          good == curve.points.end() || good->substeps == 0 ? p.cpu_alone : cost(*good) * p.substeps / good->substeps;
      if (p.blew_up) crosses += fmt::format("{:.9g} {:g}\n", whole, row(number));
    }
    if (crosses.empty()) return;
    script += fmt::format("$b{} << EOD\n{}EOD\n", number, crosses);
    plot_ += fmt::format("{}$b{} with points pointtype 2 pointsize 1 linewidth 2 linecolor rgb '{}' notitle",
                         separator(), number, integrator_colour(number));
  }

  const char* separator() const { return plot_.empty() ? "plot " : ", "; }

  std::string script, plot_;
};

Plot plot_of(const SolverCase& c, double bound) {
  return {solver_plot_name(c),
          fmt::format("{}: left is cheaper, down is truer; numbers are steps a frame, crosses above blew up.", c.name),
          Diagram(c, bound).finished()};
}

}  // namespace

std::string solver_plot_name(const SolverCase& c) { return fmt::format("solver-{}", c.key); }

std::vector<Plot> solver_plots(const SolverResults& results) {
  std::vector<Plot> plots;
  for (const SolverCase& c : results.cases) plots.push_back(plot_of(c, results.bound));
  std::erase_if(plots, [](const Plot& p) { return p.script.empty(); });
  return plots;
}

}  // namespace app
