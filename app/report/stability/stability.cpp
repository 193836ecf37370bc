#include <algorithm>
#include <array>
#include <functional>

#include "app/base/usage_error.h"
#include "app/files/output_file.h"
#include "app/report/files.h"
#include "app/report/stability/cell.h"
#include "app/report/stability/results.h"

namespace app::report {
namespace {

constexpr std::array stiffnesses{1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8};  // N/m
constexpr std::array factors{1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5};    // times a scene's own
constexpr std::array quick_stiffnesses{1e1, 1e4, 1e8};
constexpr std::array quick_factors{1e-1, 1e0, 1e3};
constexpr std::array quick_cases{"rest", "flattened", "impact-100"};

struct Effort {
  double seconds;                 // simulated
  std::uint64_t reference_steps;  // at most
};

/// A case, or the user's scene, at one stiffness.
struct Job {
  std::size_t section, row;
  std::function<StabilityScene()> make;
  StabilityStart start{};
};

class StabilityReport {
 public:
  explicit StabilityReport(const ReportOptions& options)
      : effort_(options.quick ? Effort{1, 15'000} : Effort{2, 100'000}) {
    results.options = options;
    results.seconds = effort_.seconds;
    results.dts = {1.0 / 30, 1.0 / 60, 1.0 / 240};
    for (const softbody::Integrator& i : softbody::integrators()) results.integrators.push_back(&i);
  }

  void add_case(const StabilityCase& c) {
    results.sections.push_back({std::string(c.key), std::string(c.name), {}});
    for (const double k : results.options.quick ? std::span<const double>(quick_stiffnesses) : stiffnesses)
      add(k, [make = c.make, k] { return make(k); });
  }

  void add_scene(const softbody::Scene& scene) {
    results.sections.push_back({scene.key, scene.name, {}});
    for (const double factor : results.options.quick ? std::span<const double>(quick_factors) : factors)
      add(factor, [scene, factor] { return scaled(scene, factor); });
  }

  /// Cells are independent of each other, so they run side by side.
  void run(collide::Workers& workers) {
    in_parallel(workers, "reference", jobs_.size(), [&](std::size_t i) { prepare_job(jobs_[i]); });
    const std::size_t cells = results.integrators.size() * results.dts.size();
    // In this order the expensive cells, those of stiff springs and short frames, are not all at the end.
    in_parallel(workers, "cell", jobs_.size() * cells, [&](std::size_t i) { run_one(jobs_[i / cells], i % cells); });
    if (results.options.scene) return;
    const auto ks = results.options.quick ? std::span<const double>(quick_stiffnesses) : stiffnesses;
    results.steps.assign(results.integrators.size(), std::vector<StableStep>(ks.size()));
    in_parallel(workers, "largest step", ks.size() * results.integrators.size(), [&](std::size_t i) {
      const std::size_t which = i / ks.size(), k = i % ks.size();
      results.steps[which][k] = find_stable_step(*results.integrators[which], ks[k]);
    });
  }

  StabilityResults results;

 private:
  void add(double stiffness, std::function<StabilityScene()> make) {
    StabilitySection& section = results.sections.back();
    jobs_.push_back({results.sections.size() - 1, section.rows.size(), std::move(make)});
    StabilityRow& row = section.rows.emplace_back(StabilityRow{stiffness, {}, {}});
    for (std::size_t i = 0; i < results.integrators.size(); ++i)
      for (std::size_t dt = 0; dt < results.dts.size(); ++dt) row.cells.push_back({i, dt});
  }

  StabilityRow& row_of(const Job& job) { return results.sections[job.section].rows[job.row]; }

  void prepare_job(Job& job) {
    StabilityRow& row = row_of(job);
    try {
      job.start = prepare(job.make(), effort_.seconds);
      find_reference(job.start, effort_.reference_steps);
    } catch (const softbody::SceneError& error) {
      for (StabilityCell& cell : row.cells) cell.figures.refused = error.what();
    }
    row.not_judged = job.start.not_judged;
  }

  void run_one(const Job& job, std::size_t index) {
    StabilityCell& cell = row_of(job).cells[index];
    if (!cell.figures.refused.empty()) return;
    cell.figures = run_cell(job.start, *results.integrators[cell.integrator], results.dts[cell.dt]);
  }

  static void in_parallel(collide::Workers& workers, const std::string& what, std::size_t count,
                          const std::function<void(std::size_t)>& task) {
    run_in_parallel(
        workers, count, [&](std::size_t i) { return what + " " + std::to_string(i + 1); }, task);
  }

  Effort effort_;
  std::vector<Job> jobs_;
};

}  // namespace

void report_stability(const ReportOptions& options) {
  StabilityReport report(options);
  if (options.scene) {
    const softbody::Scene scene = chosen_scenes(options).front();
    if (scene.bodies.empty()) throw UsageError("scene '" + scene.key + "': no body to judge; add a [[body]]");
    report.add_scene(scene);
  } else {
    for (const StabilityCase& c : stability_cases())
      if (!options.quick || std::ranges::count(quick_cases, c.key) > 0) report.add_case(c);
  }
  files::prepare_folder(options.out);
  collide::Workers workers(options.threads.value_or(options.cores));
  report.run(workers);
  write_report(options, stability_table(report.results), "stability.md", stability_page(report.results));
}

}  // namespace app::report
