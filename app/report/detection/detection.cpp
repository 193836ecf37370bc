#include <algorithm>

#include "app/files/output_file.h"
#include "app/report/detection/recording.h"
#include "app/report/detection/results.h"
#include "app/report/files.h"

namespace app::report {
namespace {

constexpr collide::Index growth_bodies[] = {3, 16, 47, 200, 800};  // and all

/// A sequence of the user's own is one scene only, and often one large body: then brute force may take some seconds.
compare::SweepLimits limits_of(const ReportOptions& options) {
  if (options.quick) return {.repetitions = 3, .repeat_ms = 50};
  if (!options.files.empty()) return {.budget = 5'000'000'000};
  return {};
}

/// Lets every method run on all bodies of the largest scene, brute force for some ten seconds; except in a quick
/// report.
compare::SweepLimits growth_limits(const DetectionResults& results) {
  compare::SweepLimits limits = results.limits;
  if (!results.options.quick) limits.budget = 500'000'000'000;
  return limits;
}

StateResult sweep_state(const RecordedState& state, const std::vector<compare::Configuration>& configurations,
                        const compare::SweepLimits& limits, collide::Workers& workers, const std::string& what) {
  compare::Sweep sweep(state.view(), configurations, limits, workers);
  while (sweep.step()) say(what, sweep.progress());
  return {state.frame, state.bodies.count(), state.bodies.vertex_count(), sweep.report()};
}

SceneResult sweep_scene(const Recording& recording, const DetectionResults& results, collide::Workers& workers) {
  SceneResult scene{recording.scene, recording.name, recording.buckets, {}};
  for (const RecordedState& state : recording.states) {
    const std::string what = recording.scene + ", frame " + std::to_string(state.frame);
    scene.states.push_back(sweep_state(state, recording.configurations, results.limits, workers, what));
  }
  return scene;
}

/// Returns those with the paper's level and the automatic cell, with its 1001 buckets and with the sweep's largest
/// number.
std::vector<compare::Configuration> growth_configurations(std::vector<compare::Configuration> all) {
  std::erase_if(all, [](const compare::Configuration& c) {
    const collide::Method& method = method_of(c);
    const bool level = !method.uses_levels || c.settings.levels == paper_level;
    const bool hash =
        !method.uses_hash ||
        (c.cell == 1 && (c.settings.buckets == 1001 || c.settings.buckets == compare::sweep_buckets.back()));
    return !(level && hash);
  });
  return all;
}

SceneResult sweep_growth(const Recording& recording, const DetectionResults& results, collide::Workers& workers) {
  SceneResult growth{recording.scene, recording.name, recording.buckets, {}};
  const RecordedState& all = recording.states.front();  // no pile yet: the middle is as dense as the rest
  const auto configurations = growth_configurations(recording.configurations);
  const auto add = [&](const RecordedState& state) {
    const std::string what = "growth, bodies: " + std::to_string(state.bodies.count());
    growth.states.push_back(sweep_state(state, configurations, growth_limits(results), workers, what));
  };
  for (const collide::Index count : growth_bodies) {
    if (count < all.bodies.count()) add(middle_bodies(all, count));
  }
  if (!growth.states.empty()) add(all);
  return growth;
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
    const Recording recording = record(scene, options.quick, options.cores);
    if (swept) results.scenes.push_back(sweep_scene(recording, results, workers));
    if (largest) results.growth = sweep_growth(recording, results, workers);
  }
}

void measure_sequence(const ReportOptions& options, DetectionResults& results, collide::Workers& workers) {
  const Recording recording = record_sequence(options);
  files::prepare_folder(options.out);
  results.scenes.push_back(sweep_scene(recording, results, workers));
}

}  // namespace

void report_detection(const ReportOptions& options) {
  DetectionResults results{.options = options, .limits = limits_of(options)};
  collide::Workers workers(options.threads.value_or(1));
  if (options.files.empty())
    measure_scenes(options, results, workers);
  else
    measure_sequence(options, results, workers);
  write_report(options, detection_table(results), "report.md", detection_page(results));
}

}  // namespace app::report
