#include <algorithm>

#include "app/files/output_file.h"
#include "app/report/detection/results.h"
#include "app/report/files.h"

namespace app::report {
namespace {

constexpr std::array<std::string_view, 6> driven_scenes{"A", "B", "C", "D", "drop", "container"};
constexpr std::uint64_t max_driven_vertices = 8'000;               // of a scene that is asked for
constexpr collide::Index growth_bodies[] = {3, 16, 47, 200, 800};  // and all

/// A sequence of the user's own is one scene only, and often one large body: then brute force may take some seconds.
compare::SweepLimits limits_of(const ReportOptions& options) {
  if (options.quick) return {.repetitions = 3, .repeat_ms = 50};
  if (!options.files.empty()) return {.budget = 5'000'000'000};
  return {};
}

/// Measures all configurations on all states. what: says which state it is.
void sweep(SceneResult& scene, TimedParts& timed, const compare::SweepLimits& limits, collide::Workers& workers,
           const auto& what) {
  for (MeasuredState& state : scene.states) {
    compare::Sweep sweep(state.view(), scene.configurations, limits, workers);
    while (sweep.step()) say(what(state), sweep.progress());
    state.sweep = sweep.report();
    timed += state.sweep.timed;
  }
}

void sweep_frames(SceneResult& scene, DetectionResults& results, collide::Workers& workers) {
  sweep(scene, results.timed, results.limits, workers,
        [&](const MeasuredState& state) { return scene.scene + ", frame " + std::to_string(state.frame); });
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

/// Returns piles of more and more bodies out of the scene's first state, which is no pile yet: the middle is as dense
/// as the rest.
SceneResult sweep_growth(const SceneResult& scene, DetectionResults& results, collide::Workers& workers) {
  SceneResult growth{scene.scene, scene.name, scene.buckets, growth_configurations(scene.configurations)};
  const MeasuredState& all = scene.states.front();
  for (const collide::Index count : growth_bodies)
    if (count < all.bodies.count()) growth.states.push_back(middle_bodies(all, count));
  if (!growth.states.empty()) growth.states.push_back(all);
  compare::SweepLimits limits = results.limits;
  // Every method is to run on all bodies of the largest scene, brute force for some ten seconds.
  if (!results.options.quick) limits.budget = 500'000'000'000;
  sweep(growth, results.timed, limits, workers,
        [](const MeasuredState& state) { return "growth, bodies: " + std::to_string(state.bodies.count()); });
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
    SceneResult result = record(scene, options.quick, options.cores);
    if (swept) sweep_frames(result, results, workers);
    if (largest) results.growth = sweep_growth(result, results, workers);
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
    sweep_frames(sequence, results, workers);
  }
  write_report(options, detection_table(results), "report.md", detection_page(results),
               {{"misses.csv", misses_table(results)}});
}

}  // namespace app::report
