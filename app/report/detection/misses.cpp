// What misses cost: scenes that a method drives, judged by the surface oracle.

#include <algorithm>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/compare/compare.h"
#include "app/compare/world_oracle.h"
#include "app/report/detection/results.h"
#include "app/report/files.h"
#include "softbody/world/world.h"

namespace app::report {
namespace {

constexpr std::array driven_cells{0.15, 0.5, 0.75, 1.0, 1.5};  // in units of the automatic cell size
constexpr int frames_per_look = 10;

/// Returns when a run ends, if bodies are awake: the paper's scenes have 800 frames.
int frames_of(const ReportOptions& options) { return options.quick ? 60 : 800; }

bool is_literal(const DrivenRun& run) { return method_of(run.configuration).key == collide::paper_method; }

DrivenRun drive(softbody::Scene scene, const compare::Configuration& c, DetectionResults& results) {
  DrivenRun run{scene.key, c};
  scene.method = method_of(c).key;
  scene.collision = c.settings;
  softbody::World world(std::move(scene), {.threads = results.options.threads.value_or(1)});
  compare::WorldOracle oracle(results.options.cores);
  compare::RunFigures figures;
  const int frames = frames_of(results.options);
  for (bool ended = false; !ended;) {
    const double start = process_seconds();
    const double ms = time_ms([&] { world.step(); });
    results.timed += {.wall = 1e-3 * ms, .processor = process_seconds() - start};
    figures.add(world);
    run.detect.ms.push_back(world.last_step().detect_ms);
    ended = world.all_at_rest() || world.frame() == frames;
    if (!ended && world.frame() % frames_per_look != 0) continue;
    say(run.scene + ", driven by " + method_of(c).name, double(world.frame()) / frames);
    figures.add(collide::oracle::figures_of(world.simulated().positions, oracle.overlaps(world)));
  }
  run.vertices = world.bodies().vertex_count();
  run.totals = figures.totals();
  return run;
}

/// Returns those of a scene that its table and plot show: of the rivals only the fastest.
std::vector<const DrivenRun*> shown(std::span<const DrivenRun> runs) {
  std::vector<const DrivenRun*> all;
  const DrivenRun* fastest = nullptr;
  for (const DrivenRun& run : runs) {
    if (method_of(run.configuration).group == collide::MethodGroup::paper)
      all.push_back(&run);
    else if (!fastest || run.detect.median() < fastest->detect.median())
      fastest = &run;
  }
  if (fastest) all.push_back(fastest);
  return all;
}

/// Returns the most vertices that a run left inside others, and the depth of the deepest of any run (m): "417 (0.42)".
std::string left_inside(std::span<const DrivenRun> runs, const auto& counts) {
  std::size_t inside = 0;
  double depth = 0;  // m
  for (const DrivenRun& run : runs) {
    if (!counts(run)) continue;
    inside = std::max(inside, run.totals.inside);
    depth = std::max(depth, run.totals.depth);
  }
  return grouped(inside) + (inside > 0 ? fmt::format(" ({:.2g})", depth) : "");
}

TableRow left_inside_row(std::span<const DrivenRun> runs) {
  TableRow row{{"scene", runs.front().scene}, {"vertices", grouped(runs.front().vertices)}};
  for (const double cell : driven_cells)
    row.push_back({fmt::format("x{:g}", cell), left_inside(runs, [&](const DrivenRun& run) {
                     return is_literal(run) && run.configuration.cell == cell;
                   })});
  row.push_back(
      {"nothing missed", left_inside(runs, [](const DrivenRun& run) { return method_of(run.configuration).exact; })});
  return row;
}

TableRow row_of(const DrivenRun& run) {
  const compare::Configuration& c = run.configuration;
  const compare::RunTotals& t = run.totals;
  return {{"scene", run.scene},
          {"driven by", method_of(c).name},
          {"level", when(method_of(c).uses_levels, c.settings.levels)},
          {"buckets", when(method_of(c).uses_hash, c.settings.buckets)},
          {"cell x", when(method_of(c).uses_hash, c.cell)},
          {"cell (m)", when(method_of(c).uses_hash, fmt::format("{:.3f}", c.settings.cell_size->x))},
          {"frames", t.frames},
          {"ms", fmt::format("{:.3g}", run.detect.median())},
          {"recall", fmt::format("{:.4g}", t.recall())},
          {"most inside", t.most_inside},
          {"deepest (m)", fmt::format("{:.2g}", t.deepest)},
          {"inside at the end", t.inside},
          {"depth at the end (m)", fmt::format("{:.2g}", t.depth)}};
}

Plot left_inside_against_time(const Page& page, std::span<const DrivenRun> runs) {
  Plot plot = page.plot_of("left inside against time", "misses-" + runs.front().scene,
                           fmt::arg("scene", runs.front().scene), fmt::arg("vertices", grouped(runs.front().vertices)));
  std::string title;
  for (const DrivenRun* run : shown(runs)) {
    const collide::Method& method = method_of(run->configuration);
    const int level = run->configuration.settings.levels;
    const std::string name = is_literal(*run) ? fmt::format("{}, level {}", method.name, level) : method.name;
    if (name != title)
      plot.series.push_back({name, is_literal(*run) ? series_colour(plot.series.size()) : colour(method),
                             fmt::format("linespoints pointtype {} pointsize 1.5 linewidth 1.5", point_type(method))});
    title = name;
    const bool labelled = is_literal(*run) && run->totals.inside > 0;
    plot.series.back().points.push_back({run->detect.median(), double(run->totals.inside),
                                         labelled ? fmt::format("x{:g}", run->configuration.cell) : ""});
  }
  return plot;
}

}  // namespace

void drive(const softbody::Scene& scene, DetectionResults& results) {
  const softbody::World start(scene, {.threads = results.options.cores});
  const auto drive_by = [&](std::string_view method, int levels, double cell) {
    compare::Configuration c{compare::method_index(method), start.collision(), cell};
    c.settings.levels = levels;
    c.settings.cell_size = start.automatic_cell_size(levels) * float(cell);
    results.runs.push_back(drive(scene, c, results));
  };
  for (const int levels : results.options.quick ? std::vector{paper_level} : std::vector{0, 1, 3, 6, 9})
    for (const double cell : driven_cells) drive_by(collide::paper_method, levels, cell);
  for (const collide::Method& method : collide::method_table())
    if (method.exact && method.key != collide::reference_method) drive_by(method.key, paper_level, 1);
}

Table misses_table(const DetectionResults& results) {
  Table table;
  for (const DrivenRun& run : results.runs) table.add(row_of(run));
  return table;
}

void add_misses(Page& page, const DetectionResults& results) {
  if (results.runs.empty()) return;
  Table left, of_level;
  const auto scenes = groups_of(results.runs, &DrivenRun::scene);
  for (const std::span<const DrivenRun> runs : scenes) {
    left.add(left_inside_row(runs));
    for (const DrivenRun* run : shown(runs))
      if (run->configuration.settings.levels == paper_level) of_level.add(row_of(*run));
  }
  page.add("misses", fmt::arg("frames", frames_of(results.options)));
  page.table(left);
  page.add("misses at the paper's level");
  page.table(of_level, 2);
  for (const std::span<const DrivenRun> runs : scenes) page.plot(left_inside_against_time(page, runs));
}

}  // namespace app::report
