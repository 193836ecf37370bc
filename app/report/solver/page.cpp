#include <cassert>
#include <cmath>
#include <functional>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/report/solver/results.h"
#include "app/report/sums.h"
#include "softbody/state/lanes.h"

namespace app::report {

// ---- the table of figures ----

Table solver_table(const SolverResults& results) {
  Table table;
  for (const SolverCase& c : results.cases)
    for (const WorkCurve& curve : c.curves)
      for (const WorkPoint& p : curve.points) {
        const bool fixed = p.substeps > 0, good = !p.blew_up;
        table.add(
            {{"scene", c.scene.key},
             {"integrator", curve.integrator->key},
             {"substeps", when(fixed, p.substeps)},
             {"substeps_taken", p.taken},
             {"steps_per_second", when(fixed, p.substeps * curve.integrator->substeps_per_step / solver_frame_time)},
             {"cpu_ms_alone", p.cpu_alone},
             {"cpu_ms_batch", p.cpu_batch},
             {"blew_up", p.blew_up},
             {"error", when(good, p.error)},
             {"energy_error", when(good, p.energy)},
             {"linear_error", when(good, p.linear)},
             {"angular_error", when(good, p.angular)},
             {"volume_error", when(good, p.volume)},
             {"internal_speed", when(good, p.speed)},
             {"observed_order", c.order(curve, results.effort.bound)},
             {"own_substeps", when(curve.own.has_value(), curve.own.value_or(WorkPoint{}).taken)},
             {"own_error", when(curve.own && !curve.own->blew_up, curve.own.value_or(WorkPoint{}).error)},
             {"promised_error", c.allowed()},
             {"promise_kept", c.keeps_promise()},
             {"reference_step", c.reference.step},
             {"reference_change", c.reference.change},
             {"reference_converged", c.reference.converged},
             {"perturbation_growth", c.reference.growth}});
      }
  return table;
}

namespace {

// ---- plots ----

/// Returns the height (R) of the crosses of curve `number`. Each curve has a row above all errors, so that crosses do
/// not hide each other.
double cross_height(std::size_t number) { return 20 * std::pow(1.6, double(number)); }

void add_errors(Plot& plot, const WorkCurve& curve, std::size_t number, std::optional<double> order) {
  // The single point of an integrator that chooses its steps lies under others' curves: a large open diamond shows
  // around them.
  const bool automatic = curve.integrator->automatic;
  Series series{fmt::format("{}{}", curve.integrator->name, order ? fmt::format(" (order {:.1f})", *order) : ""),
                series_colour(number),
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
  Series series{"", series_colour(number), "points pointtype 2 pointsize 1 linewidth 2"};
  for (const WorkPoint& p : curve.points)
    if (p.blew_up)
      series.points.push_back({known ? good->cost() * p.substeps / good->substeps : p.cpu_alone, cross_height(number)});
  plot.add(std::move(series));
}

Plot error_against_time(const Page& page, const SolverCase& c, double bound) {
  Plot plot = page.plot_of("error against time", "solver-" + c.scene.key, fmt::arg("scene", c.scene.name),
                           fmt::arg("growth", c.reference.growth), fmt::arg("top", cross_height(c.curves.size())),
                           fmt::arg("uncertainty", c.uncertainty(bound)));
  for (std::size_t i = 0; i < c.curves.size(); ++i) add_errors(plot, c.curves[i], i, c.order(c.curves[i], bound));
  for (std::size_t i = 0; i < c.curves.size(); ++i) add_crosses(plot, c.curves[i], i);
  return plot;
}

// ---- the page ----

constexpr std::array bounds{1e-1, 1e-2, 5e-3, 2e-3, 1e-3, 1e-4};  // R

std::string two_digits(std::optional<double> value) { return value ? fmt::format("{:.2g}", *value) : ""; }

/// Returns the point that has least of a figure, of those within an error; nothing if there is none or all blew up.
template <class Figure>
const WorkPoint* least(const WorkCurve& curve, const Figure& figure, double error = HUGE_VAL) {
  const WorkPoint* best = nullptr;
  for (const WorkPoint& p : curve.points)
    if (!p.blew_up && p.error <= error && (!best || std::invoke(figure, p) < std::invoke(figure, *best))) best = &p;
  return best;
}

/// Returns the cost of the cheapest point within an error, and its steps: "1.36 (16)".
std::string cheapest(const WorkCurve& curve, double error) {
  const WorkPoint* best = least(curve, &WorkPoint::cost, error);
  if (!best) return "";
  return brief(best->cost()) + (best->substeps > 0 ? fmt::format(" ({})", best->substeps) : "");
}

/// All scenes at one error.
void add_overview(Page& page, const SolverResults& r) {
  constexpr double bound = 2e-3;  // R
  assert(!r.cases.empty());
  Table table;
  for (std::size_t i = 0; i < r.cases.front().curves.size(); ++i) {
    TableRow row{{"integrator", r.cases.front().curves[i].integrator->name}};
    for (const SolverCase& c : r.cases) {
      const std::string cost = cheapest(c.curves[i], bound);
      const WorkPoint* best = least(c.curves[i], &WorkPoint::error);
      row.push_back({c.scene.name, !cost.empty() ? cost
                                   : best        ? fmt::format("only {:.4g} R", best->error)
                                                 : "blew up"});
    }
    table.add(row);
  }
  page.add("overview", fmt::arg("bound", bound));
  page.table(table);
}

/// Shows whether `auto` keeps its promise, beside the integrators that the promise is about.
void add_promise(Page& page, const SolverResults& r) {
  Table table;
  for (const SolverCase& c : r.cases) {
    TableRow row{{"scene", c.scene.name}};
    for (const WorkCurve& curve : c.curves) {
      if (!curve.own) continue;
      const WorkPoint& own = *curve.own;
      row.push_back({fmt::format("{}: R", curve.integrator->name), own.blew_up ? "blew up" : two_digits(own.error)});
      row.push_back({fmt::format("{}: substeps", curve.integrator->name), fmt::format("{:.3g}", own.taken)});
    }
    row.push_back({"promised: R", two_digits(c.allowed())});
    row.push_back({"promise", c.keeps_promise() ? "kept" : "MISSED"});
    table.add(row);
  }
  page.add("promise");
  page.table(table);
}

void add_stiffness(Page& page, const SolverResults& r) {
  Table table;
  for (const auto& meshes : groups_of(r.stiffness, &Stiffness::body))
    for (const Stiffness& s : meshes) {
      const auto beside_first = [](double value, double first) {
        return fmt::format("{:+.1f} %", 100 * (value / first - 1));
      };
      table.add({{"body", s.body},
                 {"particles", whole(double(s.particles))},
                 {"sag, R", brief(s.sag)},
                 {"beside the coarsest", beside_first(s.sag, meshes[0].sag)},
                 {"period, ms", brief(1e3 * s.period)},
                 {"beside it", beside_first(s.period, meshes[0].period)}});
    }
  if (table.empty()) return;
  page.add("stiffness");
  page.table(table);
}

Table costs(const SolverResults& r, const SolverCase& c) {
  Table table;
  for (const WorkCurve& curve : c.curves) {
    const auto order = c.order(curve, r.effort.bound);
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
    const WorkPoint* best = least(curve, &WorkPoint::error);
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
                 {c.scene.at_rest ? "jitter, m/s" : "inner speed, m/s", when(best, two_digits(p->speed))}});
    }
  }
  return table;
}

/// Says which curves end before the reference's own uncertainty, and why.
void add_left_out(Page& page, const SolverResults& r, const SolverCase& c) {
  const double known = c.uncertainty(r.effort.bound);
  bool all_end = true;
  for (const bool too_many : {false, true}) {
    std::vector<std::string> list;
    for (const WorkCurve& curve : c.curves) {
      const WorkPoint& last = curve.points.back();
      if (last.substeps == 0 || curve.reaches(known) || (last.substeps >= r.effort.max_substeps) != too_many) continue;
      list.push_back(fmt::format("{} beyond {} steps per frame{}", curve.integrator->name, last.substeps,
                                 last.blew_up ? " (blew up)" : ""));
    }
    if (list.empty()) continue;
    all_end = false;
    page.text("Left out, above the reference's uncertainty of {:.2g} R, since {}: {}.", known,
              too_many ? "no more steps were tried" : fmt::format("runs took longer than {:g} s", r.effort.seconds),
              joined(list, "; "));
  }
  if (all_end) page.text("All curves end at an error of {:.2g} R, the uncertainty of the reference.", known);
}

}  // namespace

Page solver_page(const SolverResults& results) {
  Page page(results.options);
  page.introduce(fmt::arg("seconds", solver_seconds), fmt::arg("frame_rate", 1 / solver_frame_time),
                 fmt::arg("repetitions", results.effort.repetitions), fmt::arg("run_seconds", results.effort.seconds),
                 fmt::arg("lanes", softbody::lanes), fmt::arg("bound", results.effort.bound),
                 fmt::arg("substeps", results.effort.max_substeps),
                 fmt::arg("order_error", SolverCase::max_order_error), fmt::arg("clear_fall", SolverCase::clear_fall),
                 fmt::arg("least_order", -std::log2(SolverCase::clear_fall)));
  page.warn_if_busy(results.timed);
  add_overview(page, results);
  add_promise(page, results);
  add_stiffness(page, results);
  if (!results.coarse.runs.empty()) {
    page.add("coarse", fmt::arg("vertices", whole(double(results.coarse.vertices))));
    page.table(results.coarse.runs);
  }
  for (const SolverCase& c : results.cases) {
    const SolverReference& r = c.reference;
    page.add("case", fmt::arg("name", c.scene.name), fmt::arg("reference", r.what), fmt::arg("step", r.step),
             fmt::arg("change", r.change), fmt::arg("growth", r.growth),
             fmt::arg("caveat", r.converged ? "" : ", so it has not converged: smaller errors mean nothing"));
    if (c.scene.of_centres) page.text("Here the error is the largest of a body's centre.");
    page.text("ms for an error of at most ... (steps per frame):");
    page.table(costs(results, c));
    add_left_out(page, results, c);
    page.text("With the fewest steps that do not blow up, and with the steps that give the least error:");
    page.table(details(c));
    page.plot(error_against_time(page, c, results.effort.bound));
  }
  return page;
}

}  // namespace app::report
