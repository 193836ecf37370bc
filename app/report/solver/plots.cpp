#include <algorithm>

#include "app/base/text.h"
#include "app/report/integrator_colours.h"
#include "app/report/solver/results.h"

namespace app {
namespace {

/// A full batch's, where there is one.
double cost(const WorkPoint& p) { return p.cpu_batch.value_or(p.cpu_alone); }

class Diagram {
 public:
  void add(const WorkCurve& curve, std::size_t number) {
    std::string good;
    for (const WorkPoint& p : curve.points)
      if (!p.blew_up) good += format("%.9g %.9g %s\n", cost(p), std::max(p.error, 1e-9), steps_text(p).c_str());
    const char* colour = integrator_colour(number);
    if (!good.empty()) {
      script += joined(format("$g%zu << EOD\n", number), good, "EOD\n");
      plot_ += joined(separator(), format("$g%zu with linespoints pointtype 7 pointsize 0.8 linewidth 2", number),
                      " linecolor rgb '", colour, "' title ", literal(title(curve)),
                      format(", $g%zu using 1:2:3 with labels offset 0.9,0.5 font ',8' textcolor rgb '%s' notitle",
                             number, colour));
    }
    blown_.emplace_back(colour, curve.points);
  }

  /// Crosses along the upper edge.
  std::string finished() {
    for (std::size_t i = 0; i < blown_.size(); ++i) {
      const auto& [colour, points] = blown_[i];
      // Runs that blow up end early: they would have cost what their steps cost elsewhere on the curve.
      const auto good = std::ranges::find(points, false, &WorkPoint::blew_up);
      std::string crosses;
      for (const WorkPoint& p : points) {
        const double whole =
            good == points.end() || good->substeps == 0 ? p.cpu_alone : cost(*good) * p.substeps / good->substeps;
        if (p.blew_up) crosses += format("%.9g %g\n", whole, top);
      }
      if (crosses.empty()) continue;
      script += joined(format("$b%zu << EOD\n", i), crosses, "EOD\n");
      plot_ += joined(separator(), format("$b%zu with points pointtype 2 pointsize 1.5 linewidth 2", i),
                      " linecolor rgb '", colour, "' notitle");
    }
    return plot_.empty() ? "" : joined(script, plot_, "\n");
  }

  std::string script;
  static constexpr double top = 20;  // R

 private:
  const char* separator() const { return plot_.empty() ? "plot " : ", "; }
  static std::string title(const WorkCurve& curve) {
    const auto order = curve.order();
    return joined(curve.integrator->name, order ? format(" (order %.1f)", *order) : "");
  }
  std::string plot_;
  std::vector<std::pair<const char*, std::vector<WorkPoint>>> blown_;
};

Plot plot_of(const SolverCase& c) {
  Diagram d;
  d.script =
      joined(plot_style, "set title ",
             literal(joined(c.name, format(": error against run time (a disturbance grows %.3g times)", c.growth))),
             format("\nset yrange [*:%g]\nset ytics format '%%g'\n", 2 * Diagram::top),
             "set xlabel 'processor time, ms a simulated second a body'\nset ylabel 'error in position, RMS / R'\n");
  for (std::size_t i = 0; i < c.curves.size(); ++i) d.add(c.curves[i], i);
  return {solver_plot_name(c),
          joined(c.name, ": left is cheaper, down is truer; numbers are steps a frame, crosses blew up."),
          d.finished()};
}

}  // namespace

std::string solver_plot_name(const SolverCase& c) { return joined("solver-", c.key); }

std::vector<Plot> solver_plots(const SolverResults& results) {
  std::vector<Plot> plots;
  for (const SolverCase& c : results.cases) plots.push_back(plot_of(c));
  std::erase_if(plots, [](const Plot& p) { return p.script.empty(); });
  return plots;
}

}  // namespace app
