#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "app/report/solver/results.h"

namespace app {
namespace {

constexpr std::array bounds{1e-1, 1e-2, 5e-3, 2e-3, 1e-3, 1e-4};  // R

void add_introduction(Page& page, const SolverResults& r) {
  page.text("# Solvers: error against run time");
  page.text("`{}` makes this report.", r.command);
  std::vector<std::string> items{
      fmt::format(
          "Every integrator advances each scene by {:g} s in frames of 1/{:.0f} s, with 1, 2, 4 ... of its steps "
          "a frame (each step of XPBD has 20 substeps; `auto` chooses its own steps). Error: RMS over the "
          "particles of the difference to the reference, in radii R, at the end.",
          r.seconds, 1 / r.frame_time),
      fmt::format(
          "ms: processor time of the thread for whole steps, per simulated second; the median of {} repetitions "
          "that take turns, or of fewer where these took {:g} s. Bodies of one mesh and material are solved "
          "side by side, one per SIMD lane. \"Batch\" is the cost per body when eight are solved side by side. "
          "\"Alone\" is the cost of a lone body, which leaves seven lanes empty. Plots show the batch. Scenes "
          "from files have the bodies that they have; their cost stands under \"alone\".",
          r.repetitions, r.max_run_seconds),
      fmt::format("Reference: RK4 in double, written apart from the solvers, at a step that was halved until the "
                  "positions changed by less than {:g} R. Scenes with parts that it does not model are compared with "
                  "the world's rk4 in floats.",
                  r.bound),
      fmt::format("A curve ends with the first error that is not above the reference's own uncertainty, with the first "
                  "run that takes longer than {:g} s of processor time ({:g} s simulated), or with {} steps a frame. "
                  "Each table is followed by which. Runs are timed: on another machine a curve may end elsewhere.",
                  r.max_run_seconds, r.seconds, r.max_substeps),
      "Growth: the factor by which a disturbance of the start of 1e-8 R (floats: 1e-5 m) has grown at the end. No "
      "solver is nearer to the reference than this growth times its rounding.",
      "Energy: difference to the reference's, divided by the energy above balance at the start or by m g R, whichever "
      "is larger. Momentum: difference, divided by the body's own; only where nothing acts from outside. Inner speed: "
      "RMS of all motion except that of the body as a whole. Where a body starts in balance, this is jitter.",
      fmt::format(
          "Order: order of the error, observed from each number of steps to its double. It is the median (of an "
          "even number the mean of the middle two) over the longest row of errors, from {:g} R on, each of "
          "which is less than {:g} times the one before. Of rows of the same length the one with the most "
          "steps counts. A row has at least two falls, or one that reaches the reference's uncertainty. Since "
          "smaller falls are left out, the order is rather too high than too low, and no order below {:.1f} is "
          "seen.",
          SolverCase::max_order_error, SolverCase::clear_fall, -std::log2(SolverCase::clear_fall)),
      "`solver.csv` has every figure."};
  if (r.quick)
    items.push_back("This is the quick report: fewer scenes, steps and repetitions, and a coarser reference.");
  page.list(items);
}

std::string two_digits(std::optional<double> value) { return value ? fmt::format("{:.2g}", *value) : ""; }

/// Returns nothing if all blew up.
const WorkPoint* most_accurate(const WorkCurve& curve) {
  const WorkPoint* best = nullptr;
  for (const WorkPoint& p : curve.points)
    if (!p.blew_up && (!best || p.error < best->error)) best = &p;
  return best;
}

/// Returns the cost of the cheapest point within an error, and its steps: "1.36 (16)".
std::string cheapest(const WorkCurve& curve, double error) {
  const WorkPoint* best = nullptr;
  for (const WorkPoint& p : curve.points)
    if (!p.blew_up && p.error <= error && (!best || p.cost() < best->cost())) best = &p;
  if (!best) return "";
  return brief(best->cost()) + (best->substeps > 0 ? fmt::format(" ({})", best->substeps) : "");
}

/// All scenes at one error.
void add_overview(Page& page, const SolverResults& r) {
  constexpr double bound = 2e-3;  // R
  Table table;
  for (std::size_t i = 0; i < r.cases.front().curves.size(); ++i) {
    TableRow row{{"integrator", r.cases.front().curves[i].integrator->name}};
    for (const SolverCase& c : r.cases) {
      const std::string cost = cheapest(c.curves[i], bound);
      const WorkPoint* best = most_accurate(c.curves[i]);
      row.push_back({c.name, !cost.empty() ? cost : best ? fmt::format("only {:.4g} R", best->error) : "blew up"});
    }
    table.add(row);
  }
  page.text("## All scenes");
  page.text(
      "ms per simulated second and body, in a batch where there is one, for an error of at most {:g} R. In brackets "
      "the "
      "steps a frame (`auto` chooses its own), or instead the least error seen:",
      bound);
  page.table(table);
}

Table costs(const SolverResults& r, const SolverCase& c) {
  Table table;
  for (const WorkCurve& curve : c.curves) {
    const auto order = c.order(curve, r.bound);
    TableRow row{{"integrator", curve.integrator->name}, {"order", order ? fmt::format("{:.1f}", *order) : ""}};
    for (const double bound : bounds) row.push_back({fmt::format("{:g} R", bound), cheapest(curve, bound)});
    table.add(row);
  }
  return table;
}

/// Of each integrator the first point that did not blow up, and the most accurate.
Table details(const SolverCase& c) {
  Table table;
  for (const WorkCurve& curve : c.curves) {
    const WorkPoint* best = most_accurate(curve);
    std::vector<const WorkPoint*> shown{best ? &*std::ranges::find(curve.points, false, &WorkPoint::blew_up)
                                             : &curve.points.front()};
    if (best && best != shown.front()) shown.push_back(best);
    for (const WorkPoint* p : shown) {
      table.add({{"integrator", curve.integrator->name},
                 {"steps", when(best, steps_text(*p))},
                 {"alone, ms", when(best, brief(p->cpu_alone))},
                 {"batch, ms", when(best && p->cpu_batch, brief(p->cpu_batch.value_or(0)))},
                 {"error, R", best ? two_digits(p->error) : "blew up"},
                 {"energy", when(best, two_digits(p->energy))},
                 {"linear", when(best, two_digits(p->linear))},
                 {"angular", when(best, two_digits(p->angular))},
                 {"volume", when(best, two_digits(p->volume))},
                 {c.at_rest ? "jitter, m/s" : "inner speed, m/s", when(best, two_digits(p->speed))}});
    }
  }
  return table;
}

/// Says which curves end before the reference's own uncertainty, and why.
void add_left_out(Page& page, const SolverResults& r, const SolverCase& c) {
  const double known = c.uncertainty(r.bound);
  std::string too_long, too_many;
  for (const WorkCurve& curve : c.curves) {
    const WorkPoint& last = curve.points.back();
    if (last.substeps == 0 || curve.reaches(known)) continue;
    std::string& list = last.substeps >= r.max_substeps ? too_many : too_long;
    list += fmt::format("{}{} beyond {} steps a frame{}", list.empty() ? "" : "; ", curve.integrator->name,
                        last.substeps, last.blew_up ? " (blew up)" : "");
  }
  if (too_long.empty() && too_many.empty())
    return page.text("All curves end at an error of {:.2g} R, the uncertainty of the reference.", known);
  const auto say = [&](const std::string& why, const std::string& list) {
    if (!list.empty())
      page.text("Left out, above the reference's uncertainty of {:.2g} R, since {}: {}.", known, why, list);
  };
  say(fmt::format("runs took longer than {:g} s", r.max_run_seconds), too_long);
  say("no more steps were tried", too_many);
}

}  // namespace

Page solver_page(const SolverResults& results) {
  Page page;
  add_introduction(page, results);
  add_overview(page, results);
  for (const SolverCase& c : results.cases) {
    page.text("## {}", c.name);
    page.text(
        "Reference: {}, steps of {:.3g} s on average. Halving them changed the positions by {:.2g} R{}. A disturbance "
        "grows {:.3g} times.",
        c.reference, c.step, c.change, c.converged ? "" : ", so it has not converged: smaller errors mean nothing",
        c.growth);
    page.text("ms for an error of at most ... (steps a frame):");
    page.table(costs(results, c));
    add_left_out(page, results, c);
    page.text("With the fewest steps that do not blow up, and with the steps that give the least error:");
    page.table(details(c));
    page.plot(error_against_time(c, results.bound));
  }
  return page;
}

}  // namespace app
