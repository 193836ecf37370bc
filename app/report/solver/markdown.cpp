#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "app/report/solver/results.h"
#include "app/report/table.h"

namespace app {
namespace {

constexpr std::array bounds{1e-1, 1e-2, 5e-3, 2e-3, 1e-3, 1e-4};  // R

std::string introduction(const SolverResults& r) {
  std::string text = fmt::format("# Solvers: error against run time\n\n`{}` makes this report.\n\n", r.command);
  text += fmt::format("- Every integrator advances each scene by {:g} s in frames of 1/{:.0f} s, ", r.seconds,
                      1 / r.frame_time);
  text +=
      "with 1, 2, 4 ... of its steps a frame (XPBD: each has 20 substeps of its own; `auto` chooses its own). Error: "
      "RMS over the particles of "
      "the difference to the reference, in radii R, at the end.\n"
      "- ms: processor time of the thread for whole steps, a simulated second, ";
  text += fmt::format("median of {} repetitions which take turns, of fewer where these took {:g} s. ", r.repetitions,
                      r.longest_run);
  text +=
      "Bodies of one prototype are solved side by side, one a SIMD lane. \"Batch\" is the cost per body when eight "
      "are solved side by side, \"alone\" that of a lone body, which leaves seven lanes empty. Plots show the batch; "
      "scenes from files "
      "have the bodies that they have, and their cost stands under alone.\n"
      "- Reference: RK4 in double, written apart from the solvers, at a step that was halved until the positions "
      "changed by less than ";
  text += fmt::format("{:g} R. Scenes that have what it does not model are held against the world's rk4 in floats.\n",
                      r.bound);
  text +=
      "- A curve ends with the first error that is not above the reference's own uncertainty, with the first run that "
      "takes longer than ";
  text += fmt::format("{:g} s of processor time ({:g} s simulated), or with {} steps a frame; ", r.longest_run,
                      r.seconds, r.most_substeps);
  text += "below each table stands which. Runs are timed: on another machine a curve may end elsewhere.\n";
  text +=
      "- Growth: by how much a disturbance of the start of 1e-8 R (floats: 1e-5 m) has grown at the end. No solver is "
      "nearer to the reference than the growth times its rounding.\n"
      "- Energy: difference to the reference's, in the larger of the energy above balance at the start and m g R. "
      "Momentum: of the body's own, only where nothing acts from outside. Inner speed: RMS of what is not motion of "
      "the "
      "body as a whole; where it starts in balance, this is jitter.\n";
  text +=
      "- Order: of the error, observed from each number of steps to its double: the median (of an even number the mean "
      "of the middle two) over the longest row of errors, ";
  text += fmt::format("from {:g} R on, each of which is less than {:g} of the one before; ", SolverCase::coarsest,
                      SolverCase::clearly);
  text +=
      "of rows of the same length over that of the most steps. A row takes two falls, or one that leads as far as the "
      "reference is known. As smaller falls are left out, it is rather too high than too low, ";
  text += fmt::format("and none below {:.1f} is seen.\n", -std::log2(SolverCase::clearly));
  text += "- `solver.csv` has every figure.\n";
  if (r.quick) text += "- This is the quick report: fewer scenes, steps and repetitions, and a coarser reference.\n";
  return text + "\n";
}

std::string optional_text(const std::optional<double>& value) { return value ? fmt::format("{:.2g}", *value) : ""; }

/// Nothing: all blew up.
const WorkPoint* most_accurate(const WorkCurve& curve) {
  const WorkPoint* best = nullptr;
  for (const WorkPoint& p : curve.points)
    if (!p.blew_up && (!best || p.error < best->error)) best = &p;
  return best;
}

/// The cheapest that is at least so accurate.
std::string cheapest(const WorkCurve& curve, double bound) {
  const WorkPoint* best = nullptr;
  const auto cost = [](const WorkPoint& p) { return p.cpu_batch.value_or(p.cpu_alone); };
  for (const WorkPoint& p : curve.points)
    if (!p.blew_up && p.error <= bound && (!best || cost(p) < cost(*best))) best = &p;
  return best ? fmt::format("{} ({})", brief(cost(*best)), steps_text(*best)) : "";
}

/// All scenes at one error.
std::string overview(const SolverResults& r) {
  constexpr double bound = 2e-3;  // R
  Cells names{"integrator"};
  for (const SolverCase& c : r.cases) names.push_back(c.name);
  std::string text = fmt::format(
      "## All scenes\n\nms a simulated second per body, in a batch where there is one, for an error of at most {:g} R "
      "(steps a frame), or the least error seen:\n\n{}",
      bound, heading(names, 1));
  for (std::size_t i = 0; i < r.cases.front().curves.size(); ++i) {
    Cells cells{std::string(r.cases.front().curves[i].integrator->name)};
    for (const SolverCase& c : r.cases) {
      const std::string cost = cheapest(c.curves[i], bound);
      const WorkPoint* best = most_accurate(c.curves[i]);
      cells.push_back(!cost.empty() ? cost : best ? fmt::format("only {:.4g} R", best->error) : "blew up");
    }
    text += line(cells);
  }
  return text + "\n";
}

std::string costs(const SolverResults& r, const SolverCase& c) {
  Cells names{"integrator", "order"};
  for (const double bound : bounds) names.push_back(fmt::format("{:g} R", bound));
  std::string text = fmt::format("ms for an error of at most ... (steps a frame):\n\n{}", heading(names, 1));
  for (const WorkCurve& curve : c.curves) {
    const auto order = c.order(curve, r.bound);
    Cells cells{std::string(curve.integrator->name), order ? fmt::format("{:.1f}", *order) : ""};
    for (const double bound : bounds) cells.push_back(cheapest(curve, bound));
    text += line(cells);
  }
  return text;
}

/// The first that did not blow up, and the most accurate.
std::string details(const SolverCase& c) {
  std::string text = "\nWith the fewest steps that do not blow up, and with those of the least error:\n\n" +
                     heading({"integrator", "steps", "alone, ms", "batch, ms", "error, R", "energy", "linear",
                              "angular", "volume", c.at_rest ? "jitter, m/s" : "inner speed, m/s"},
                             1);
  for (const WorkCurve& curve : c.curves) {
    const WorkPoint* best = most_accurate(curve);
    if (!best) {
      text += line({std::string(curve.integrator->name), "", "", "", "blew up", "", "", "", "", ""});
      continue;
    }
    const WorkPoint* first = &*std::ranges::find(curve.points, false, &WorkPoint::blew_up);
    std::vector<const WorkPoint*> shown{first};
    if (best != first) shown.push_back(best);
    for (const WorkPoint* p : shown) {
      text += line({std::string(curve.integrator->name), steps_text(*p), brief(p->cpu_alone),
                    p->cpu_batch ? brief(*p->cpu_batch) : "", fmt::format("{:.2g}", p->error),
                    fmt::format("{:.2g}", p->energy), optional_text(p->linear), optional_text(p->angular),
                    optional_text(p->volume), fmt::format("{:.2g}", p->speed)});
    }
  }
  return text;
}

/// Where curves end before the reference's own uncertainty, and why.
std::string left_out(const SolverResults& r, const SolverCase& c) {
  const double known = c.known(r.bound);
  std::string too_long, too_many;
  for (const WorkCurve& curve : c.curves) {
    const WorkPoint& last = curve.points.back();
    if (last.substeps == 0 || curve.reaches(known)) continue;  // it chooses its steps, or came there
    std::string& list = last.substeps >= r.most_substeps ? too_many : too_long;
    list += fmt::format("{}{} beyond {} steps a frame{}", list.empty() ? "" : "; ", curve.integrator->name,
                        last.substeps, last.blew_up ? " (blown up)" : "");
  }
  if (too_long.empty() && too_many.empty())
    return fmt::format("\nAll curves end at an error of {:.2g} R, to which the reference is known.\n", known);
  const auto sentence = [known](const std::string& why, const std::string& list) {
    if (list.empty()) return list;
    return fmt::format("\nLeft out, short of the {:.2g} R to which the reference is known, as {}: {}.\n", known, why,
                       list);
  };
  return sentence(fmt::format("runs took longer than {:g} s", r.longest_run), too_long) +
         sentence("no more steps were tried", too_many);
}

}  // namespace

std::string solver_markdown(const SolverResults& results, const std::vector<Plot>& plots) {
  std::string text = introduction(results) + overview(results);
  for (const SolverCase& c : results.cases) {
    text += fmt::format(
        "## {}\n\nReference: {}, steps of {:.3g} s on average; halving them changed the positions by {:.2g} R{}. A "
        "disturbance grows {:.3g} times.\n\n",
        c.name, c.reference, c.step, c.change,
        c.converged ? "" : ", which is not converged: errors below that mean nothing", c.growth);
    text += fmt::format("{}{}{}{}\n", costs(results, c), left_out(results, c), details(c),
                        picture(plots, solver_plot_name(c)));
  }
  return text;
}

}  // namespace app
