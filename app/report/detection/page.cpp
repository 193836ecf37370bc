#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/report/detection/results.h"

namespace app::report {

// ---- the table of figures ----

Table detection_table(const DetectionResults& results) {
  constexpr std::array coverage_names{"exact", "covered", "exceeded", "unknown"};  // by value
  Table table;
  const auto add = [&](const SceneResult& scene) {
    for (const MeasuredState& state : scene.states)
      for (const compare::SweepRow& r : state.sweep.rows) {
        const compare::Configuration& c = r.configuration;
        const collide::Method& method = method_of(c);
        const glm::vec3 cell = *c.settings.cell_size;
        const bool run = r.not_run.empty(), known = state.sweep.reference.has_value(), scored = run && known;
        TableRow row{{"part", scene.part},
                     {"scene", scene.scene},
                     {"frame", state.frame},
                     {"change", state.change},
                     {"bodies", state.bodies.count()},
                     {"vertices", state.bodies.vertex_count()},
                     {"method", method.key},
                     {"levels", when(method.uses_levels, c.settings.levels)},
                     {"buckets", when(method.uses_hash, c.settings.buckets)},
                     {"cell", when(method.uses_hash, c.cell)},
                     {"cell_x", when(method.uses_hash, cell.x)},
                     {"cell_y", when(method.uses_hash, cell.y)},
                     {"cell_z", when(method.uses_hash, cell.z)},
                     {"not_run", r.not_run},
                     {"repetitions", r.times.ms.size()},
                     {"ms_median", run ? r.times.median() : TableCell()},
                     {"ms_min", run ? r.times.min() : TableCell()},
                     {"contacts", when(run, r.contacts)},
                     {"true_contacts", when(known, state.sweep.true_contacts)},
                     {"missed", when(scored, r.missed)},
                     {"recall", when(scored, r.recall)},
                     {"precision", when(scored, r.precision)},
                     {"pair_tests", when(run, r.counters.pair_tests)},
                     {"hashes", when(run, r.counters.hashes)},
                     {"boxes", when(run, r.counters.boxes)},
                     {"coverage", when(run, coverage_names.at(std::size_t(r.coverage)))},
                     {"memory_bytes", when(run, r.memory)}};
        for (std::size_t kind = 0; kind < r.skipped.size(); ++kind)
          row.push_back({fmt::format("skipped_{}", collide::skip_kinds[kind].key), when(run, r.skipped[kind])});
        row.push_back({"reference", known ? method_of(*state.sweep.reference).key : TableCell()});
        table.add(row);
      }
  };
  std::ranges::for_each(results.scenes, add);
  std::ranges::for_each(results.studies, add);
  return table;
}

namespace {

// ---- plots ----

/// Adds the points of a method, with one entry in the key: the higher the level, the larger.
void add_method(Plot& plot, const std::vector<Mean>& means, const auto& point, std::size_t method) {
  const collide::Method& row = collide::method_table()[method];
  std::string title = row.name;
  for (auto level = compare::sweep_levels.rbegin(); level != compare::sweep_levels.rend(); ++level) {
    const double size = row.uses_levels ? 0.6 + 0.1 * *level : 1.2;
    Series series{title, colour(row),
                  fmt::format("points pointtype {} pointsize {:g} linewidth 1.5", point_type(row), size)};
    for (const Mean& m : means)
      if (m.ran && m.configuration.method == method && (!row.uses_levels || m.configuration.settings.levels == *level))
        series.points.push_back(point(m));
    if (!series.points.empty()) title.clear();
    plot.add(std::move(series));
    if (!row.uses_levels) return;
  }
}

Plot error_against_time(const Page& page, const SceneResult& scene) {
  const std::vector<Mean> all = means(scene);
  double min = 0.1;
  for (const Mean& m : all)
    if (m.ran && m.error > 0) min = std::min(min, m.error);
  // The logarithmic axis of errors has no 0. Points without any error lie in a band below all others, with a lane per
  // method, so that they do not hide each other.
  const double top = std::pow(10, std::floor(std::log10(min)));
  const auto lane = [&](std::size_t number) { return top * std::pow(0.7, double(number) + 1); };
  const auto point = [&](const Mean& m) { return Point{m.ms, m.error > 0 ? m.error : lane(m.configuration.method)}; };
  const double bottom = lane(collide::method_table().size());
  std::string ticks;  // above the band
  for (double tick = 1; tick > 0.99 * top; tick /= 10) ticks += fmt::format("'{0:g}' {0:g}, ", tick);
  Plot plot = page.plot_of("error against time", "error-time-" + scene.scene, fmt::arg("scene", scene.name),
                           fmt::arg("bottom", bottom), fmt::arg("top", top), fmt::arg("ticks", ticks),
                           fmt::arg("middle", std::sqrt(top * bottom)));
  std::vector<Point> front;
  for (const std::size_t i : pareto_front(all)) front.push_back(point(all[i]));
  plot.add({"Pareto front", "#000000", "steps linewidth 1.5", front});
  for (std::size_t m = 0; m < collide::method_table().size(); ++m) add_method(plot, all, point, m);
  plot.add({"", "#000000", "points pointtype 6 pointsize 1.5 linewidth 1.5", front});
  return plot;
}

// ---- the page ----

std::string in_words(const compare::Configuration& c) {
  std::string text = method_of(c).name;
  if (method_of(c).uses_levels) text += fmt::format(", level {}", c.settings.levels);
  if (method_of(c).uses_hash) text += fmt::format(", {} buckets, cell x {:g}", grouped(c.settings.buckets), c.cell);
  return text;
}

// ---- Table 1 ----

std::string detections_per_second(const Mean* m) {
  if (!m) return "not run";
  return whole(1000 / m->ms) + (m->error > 0 ? fmt::format(" (recall {:.4f})", 1 - m->error) : "");
}

void add_table_1(Page& page, const DetectionResults& r) {
  Table table;
  for (const collide::Method& method : collide::method_table()) {
    if (method.key == collide::reference_method) continue;
    const std::string_view whose = method.key == collide::paper_method     ? " (the paper's)"
                                   : method.key == collide::default_method ? " (ours)"
                                                                           : "";
    const auto group = std::ranges::find(collide::method_groups, method.group, &collide::MethodGroupName::group);
    TableRow row{{"group", group->name}, {"method", fmt::format("{}{}", method.name, whose)}};
    for (const SceneResult& s : r.scenes)
      if (std::ranges::count(paper_scenes, s.scene) > 0)
        row.push_back({fmt::format("{}: {} bodies, {} buckets", s.scene, s.states.back().bodies.count(), s.buckets),
                       detections_per_second(find(means(s), method.key, paper_level, s.buckets))});
    if (row.size() == 2) return;
    table.add(row);
  }
  page.add("table 1");
  page.table(table, 2);
  page.text("The paper has its rivals and Multi-Level SB. A method without a recall in brackets misses nothing.");
}

// ---- scenes ----

/// Returns of each method the fastest configuration, and the fastest of those that miss least if that is another one.
std::vector<std::size_t> best_rows(const std::vector<Mean>& means) {
  std::vector<std::size_t> best;
  for (std::size_t method = 0; method < collide::method_table().size(); ++method) {
    std::vector<std::size_t> ran;
    for (std::size_t i = 0; i < means.size(); ++i)
      if (means[i].configuration.method == method && means[i].ran) ran.push_back(i);
    if (ran.empty()) continue;
    const auto ms = [&](std::size_t i) { return means[i].ms; };
    const auto error = [&](std::size_t i) { return std::pair(means[i].error, means[i].ms); };
    const std::size_t fastest = *std::ranges::min_element(ran, {}, ms),
                      most_accurate = *std::ranges::min_element(ran, {}, error);
    best.push_back(fastest);
    if (most_accurate != fastest) best.push_back(most_accurate);
  }
  return best;
}

Table best_table(const std::vector<Mean>& all) {
  const std::vector<std::size_t> front = pareto_front(all);
  Table table;
  for (const std::size_t i : best_rows(all)) {
    const Mean& m = all[i];
    const compare::Configuration& c = m.configuration;
    using Row = const compare::SweepRow*;
    table.add({{"method", method_of(c).name},
               {"level", when(method_of(c).uses_levels, c.settings.levels)},
               {"buckets", when(method_of(c).uses_hash, grouped(c.settings.buckets))},
               {"cell", when(method_of(c).uses_hash, fmt::format("x {:g}", c.cell))},
               {"ms median", brief(m.ms)},
               {"ms min", brief(m.mean([](Row r) { return r->times.min(); }))},
               {"recall", m.error > 0 ? fmt::format("{:.5f}", 1 - m.error) : "1"},
               {"precision", fmt::format("{:g}", m.precision)},
               {"pair tests", whole(m.mean([](Row r) { return r->counters.pair_tests; }))},
               {"hashes", whole(m.mean([](Row r) { return r->counters.hashes; }))},
               {"boxes", whole(m.mean([](Row r) { return r->counters.boxes; }))},
               {"memory KiB", whole(max_of(m.rows, &compare::SweepRow::memory) / 1024)},
               {"front", std::ranges::count(front, i) ? "yes" : ""}});
  }
  return table;
}

/// Says what is in the scene, in which states, and which method found the true contacts.
std::string scene_facts(const SceneResult& scene) {
  const MeasuredState& last = scene.states.back();
  std::string text =
      fmt::format("Bodies: {}, vertices: {}", grouped(last.bodies.count()), grouped(last.bodies.vertex_count()));
  for (const MeasuredState& s : scene.states)
    text += fmt::format("; frame {}: {} contacts", s.frame, grouped(s.sweep.true_contacts));
  if (!last.sweep.reference)
    return fmt::format("{}. No method could find the true contacts: {}.", text, last.sweep.reference_note);
  return fmt::format("{}. True contacts by {}{}{}.", text, in_words(*last.sweep.reference),
                     last.sweep.reference_note.empty() ? "" : ", since ", last.sweep.reference_note);
}

std::string over_budget(const std::vector<Mean>& means) {
  std::vector<std::string> methods;
  for (std::size_t i = 0; i < collide::method_table().size(); ++i) {
    const auto count = [&](bool ran) {
      return std::ranges::count_if(means, [&](const Mean& m) { return m.configuration.method == i && m.ran == ran; });
    };
    if (count(false) > 0)
      methods.push_back(
          fmt::format("{}: {} of {}", collide::method_table()[i].name, count(false), count(false) + count(true)));
  }
  if (methods.empty()) return "Nothing was over budget.";
  return fmt::format("Over budget in one state or more: {} configurations.", joined(methods, "; "));
}

}  // namespace

Page detection_page(const DetectionResults& results) {
  Page page(results.options);
  const compare::SweepLimits& limits = results.limits;
  const std::size_t files = results.options.files.size();
  const int threads = results.options.threads.value_or(1);
  page.introduce(fmt::arg("sequence", files > 0 ? page.text_of("sequence", fmt::arg("files", grouped(files))) : ""),
                 fmt::arg("shape", files > 0 ? "at rest (without --rest, in the first frame)" : "at rest"),
                 fmt::arg("threads", threads), fmt::arg("plural", threads == 1 ? "" : "s"),
                 fmt::arg("repetitions", limits.repetitions), fmt::arg("repeat_ms", limits.repeat_ms),
                 fmt::arg("budget", grouped(limits.budget)));
  page.warn_if_busy(results.timed);
  add_table_1(page, results);
  page.add("best", fmt::arg("scenes", files > 0 ? "The sequence" : "Scenes"));
  for (const SceneResult& scene : results.scenes) {
    const std::vector<Mean> all = means(scene);
    page.text("### {}", scene.name);
    page.text("{}", scene_facts(scene));
    page.table(best_table(all));
    page.text("{}", over_budget(all));
    page.plot(error_against_time(page, scene));
  }
  add_misses(page, results);
  add_studies(page, results);
  return page;
}

}  // namespace app::report
