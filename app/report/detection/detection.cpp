#include <algorithm>

#include <fmt/core.h>

#include "app/files/output_file.h"
#include "app/report/detection/results.h"
#include "app/report/files.h"

namespace app::report {
namespace {

constexpr std::array<std::string_view, 6> driven_scenes{"A", "B", "C", "D", "drop", "container"};
constexpr std::uint64_t max_driven_vertices = 8'000;  // of a scene that is asked for
constexpr collide::Index min_studied_bodies = 4, quick_studied_bodies = 200;

/// A sequence of the user's own is one scene only, and often one large body: then brute force may take some seconds.
compare::SweepLimits limits_of(const ReportOptions& options) {
  if (options.quick) return {.repetitions = 3, .repeat_ms = 50};
  if (!options.files.empty()) return {.budget = 5'000'000'000};
  return {};
}

/// Measures all configurations on all states.
void sweep(SceneResult& scene, const compare::SweepLimits& limits, TimedParts& timed, collide::Workers& workers) {
  for (MeasuredState& state : scene.states) {
    const std::string what = scene.scene + (state.change.empty() ? ", frame " + std::to_string(state.frame)
                                                                 : fmt::format(", {}: {}", scene.part, state.change));
    std::vector<compare::Configuration> configurations = scene.configurations;
    for (compare::Configuration& c : configurations)  // the automatic cell grows with the largest body
      *c.settings.cell_size += float(state.largest - 1) * (*c.settings.cell_size - c.settings.tolerance);
    compare::Sweep sweep(state.view(), configurations, limits, workers);
    while (sweep.step()) say(what, sweep.progress());
    state.sweep = sweep.report();
    timed += state.sweep.timed;
  }
}

/// Returns those with the paper's level and the automatic cell, with its 1001 buckets and with the sweep's largest
/// number.
std::vector<compare::Configuration> study_configurations(std::vector<compare::Configuration> all) {
  std::erase_if(all, [](const compare::Configuration& c) {
    const std::uint32_t buckets = c.settings.buckets;
    return !is_plain(c, paper_level) ||
           (method_of(c).uses_hash && buckets != 1001 && buckets != compare::sweep_buckets.back());
  });
  return all;
}

/// Measures what costs depend on, by the scene's first state. This is no pile yet: the middle is as dense as the rest.
void sweep_studies(const SceneResult& scene, DetectionResults& results, collide::Workers& workers) {
  const MeasuredState& all = scene.states.front();
  if (all.bodies.count() < min_studied_bodies) return;
  const bool quick = results.options.quick;
  for (const CostStudy& of : cost_studies()) {
    const bool growth = of.key == "growth";
    const MeasuredState state = quick && !growth ? middle_bodies(all, quick_studied_bodies) : all;
    SceneResult study{scene.scene, scene.name, scene.buckets, study_configurations(scene.configurations)};
    study.part = of.key;
    for (const double value : of.values) {
      MeasuredState changed = of.changed(state, value);
      if (study.states.empty() || study.states.back().change != changed.change)
        study.states.push_back(std::move(changed));
    }
    compare::SweepLimits limits = results.limits;
    // Every method is to run on all bodies of the largest scene once, brute force for some ten seconds.
    if (growth && !quick) limits.budget = 500'000'000'000;
    sweep(study, limits, results.timed, workers);
    results.studies.push_back(std::move(study));
  }
}

void measure_scenes(const ReportOptions& options, DetectionResults& results, collide::Workers& workers) {
  const std::vector<softbody::Scene> scenes = chosen_scenes(options);
  files::prepare_folder(options.out);
  const auto bodies = [](const softbody::Scene& scene) { return scene.bodies.size(); };
  const std::size_t max_bodies = bodies(*std::ranges::max_element(scenes, {}, bodies));
  for (const softbody::Scene& scene : scenes) {
    const bool largest = bodies(scene) == max_bodies;
    const bool swept = !options.quick || options.scene || std::ranges::count(paper_scenes, scene.key) > 0;
    if (!swept && !largest) continue;
    say(scene.key + ": simulating", 0);
    SceneResult result = record(scene, options.quick, options.cores);
    if (swept) sweep(result, results.limits, results.timed, workers);
    if (largest) sweep_studies(result, results, workers);
    if (options.scene ? vertex_count(scene) <= max_driven_vertices : std::ranges::count(driven_scenes, scene.key) > 0)
      drive(scene, results);
    if (swept) results.scenes.push_back(std::move(result));
  }
}

}  // namespace

void report_detection(const ReportOptions& options) {
  DetectionResults results{.options = options, .limits = limits_of(options)};
  collide::Workers workers(options.threads.value_or(1));
  if (options.files.empty()) {
    measure_scenes(options, results, workers);
  } else {
    SceneResult& sequence = results.scenes.emplace_back(record_sequence(options));
    files::prepare_folder(options.out);
    sweep(sequence, results.limits, results.timed, workers);
  }
  write_report(options, detection_table(results), "report.md", detection_page(results),
               {{"misses.csv", misses_table(results)}});
}

}  // namespace app::report
