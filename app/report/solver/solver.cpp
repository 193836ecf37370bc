#include <algorithm>
#include <array>

#include "app/base/timings.h"
#include "app/base/usage_error.h"
#include "app/files/output_file.h"
#include "app/report/files.h"
#include "app/report/solver/results.h"
#include "app/report/solver/trial.h"
#include "app/report/steps.h"
#include "softbody/state/lanes.h"

namespace app::report {
namespace {

constexpr std::array quick_scenes{"free-1e3", "contact-1e3", "rest-1e3", "cloth",
                                  "inflated", "stretched",   "swollen",  "four-balls"};

/// A point and its times.
struct TimedPoint {
  std::size_t scene, curve, point;  // indices
  int substeps;
  Timings alone{}, batch{};  // a run
};

class SolverReport {
 public:
  SolverReport(const ReportOptions& options, std::vector<SolverScene> scenes)
      : results{.options = options,
                .effort = options.quick ? SolverEffort{0.08, 2, 8'000} : SolverEffort{1, 3, 200'000}},
        scenes_(std::move(scenes)) {}

  void run() {
    for (std::size_t s = 0; s < scenes_.size(); ++s) find_errors(s);
    // One repetition of all points after the other: what disturbs the machine for a while disturbs all alike.
    for (int r = 0; r < effort_.repetitions; ++r) {
      for (std::size_t i = 0; i < points_.size(); ++i) {
        say("repetition " + std::to_string(r + 1), (r + double(i) / double(points_.size())) / effort_.repetitions);
        repeat(points_[i]);
      }
    }
    for (const TimedPoint& point : points_) take_times(point);
  }

  SolverResults results;

 private:
  void find_errors(std::size_t s) {
    const SolverScene& scene = scenes_[s];
    say(scene.key + ": reference", double(s) / double(scenes_.size()));
    SolverCase c = begin_case(scene, run_, effort_.bound, effort_.reference_steps);
    for (WorkCurve& curve : c.curves) {
      const softbody::Integrator& integrator = *curve.integrator;
      say(scene.key + ": " + std::string(integrator.key), double(s) / double(scenes_.size()));
      double took = 0;
      const int max_steps = integrator.automatic ? 1 : effort_.max_substeps;
      for (int n = 1; n <= max_steps && took < effort_.seconds && !curve.reaches(c.uncertainty(effort_.bound));
           n *= 2) {
        const Outcome outcome = run_solver(scene, run_, integrator, n, 1);
        took = outcome.finite ? outcome.timed.processor : 0;
        WorkPoint point = judge(c, outcome);
        if (!integrator.automatic) point.substeps = n;
        if (!point.blew_up) points_.push_back({s, std::size_t(&curve - c.curves.data()), curve.points.size(), n});
        point.cpu_alone = 1e3 * outcome.timed.processor / run_.seconds() / double(outcome.bodies.size());
        curve.points.push_back(point);
      }
    }
    results.cases.push_back(std::move(c));
  }

  void repeat(TimedPoint& p) {
    const SolverScene& scene = scenes_[p.scene];
    const softbody::Integrator& integrator = *results.cases[p.scene].curves[p.curve].integrator;
    const auto time = [&](Timings& times, int copies) {
      if (times.total() > 1e3 * effort_.seconds) return;  // the time of a long run depends less on chance
      const TimedParts timed = run_solver(scene, run_, integrator, p.substeps, copies).timed;
      times.ms.push_back(1e3 * timed.processor);
      results.timed += timed;
    };
    time(p.alone, 1);
    if (scene.repeatable) time(p.batch, softbody::lanes);
  }

  void take_times(const TimedPoint& p) {
    WorkPoint& point = results.cases[p.scene].curves[p.curve].points[p.point];
    const double bodies = double(scenes_[p.scene].scene.bodies.size());
    point.cpu_alone = p.alone.median() / run_.seconds() / bodies;
    if (!p.batch.ms.empty()) point.cpu_batch = p.batch.median() / run_.seconds() / softbody::lanes / bodies;
  }

  std::vector<SolverScene> scenes_;
  const SolverRun& run_ = results.run;
  const SolverEffort& effort_ = results.effort;
  std::vector<TimedPoint> points_;
};

std::vector<SolverScene> scenes_for(const ReportOptions& options) {
  if (options.scene) {
    const softbody::Scene scene = chosen_scenes(options).front();
    if (scene.bodies.empty()) throw UsageError("scene '" + scene.key + "': no body to measure; add a [[body]]");
    const auto joins = [](const softbody::BodySource& b) { return b.appear > 0 && b.appear <= SolverRun{}.frames; };
    const auto starts = [](const softbody::BodySource& b) { return b.appear <= 0; };
    if (std::ranges::any_of(scene.bodies, joins) || std::ranges::none_of(scene.bodies, starts))
      throw UsageError("scene '" + scene.key + "': bodies join after the start; set appear = 0");
    return {{.key = scene.key, .name = scene.name, .scene = scene, .repeatable = false}};
  }
  std::vector<SolverScene> scenes = solver_scenes();
  if (options.quick)
    std::erase_if(scenes, [](const SolverScene& s) { return std::ranges::count(quick_scenes, s.key) == 0; });
  return scenes;
}

}  // namespace

void report_solver(const ReportOptions& options) {
  std::vector<SolverScene> scenes = scenes_for(options);
  files::prepare_folder(options.out);
  SolverReport report(options, std::move(scenes));
  report.run();
  if (!options.scene) {
    report.results.stiffness = measure_stiffness(options.quick);
    report.results.coarse = measure_coarse(options.quick);
  }
  write_report(options, solver_table(report.results), "solver.md", solver_page(report.results));
}

}  // namespace app::report
