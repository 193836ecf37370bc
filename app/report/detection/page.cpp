#include <algorithm>
#include <map>

#include <fmt/ranges.h>

#include "app/base/text.h"
#include "app/report/detection/results.h"

namespace app {
namespace {

std::string in_words(const Configuration& c) {
  std::string text(method_of(c).name);
  if (method_of(c).uses_levels) text += fmt::format(", level {}", levels_of(c));
  if (method_of(c).uses_hash) text += fmt::format(", {} buckets, cell {}", buckets_of(c), cell_of(c));
  return text;
}

void add_introduction(Page& page, const DetectionResults& r) {
  const SweepLimits& l = r.limits;
  page.text("# Collision detection: what every method costs, and what it misses");
  page.text(
      "`{}` makes this report. Its times are those of the machine that it ran on: compare them with one another. "
      "Contacts, hashes and boxes are the same on every machine, and so are pair tests, except those of the exact "
      "method.",
      r.command);
  std::vector<std::string> items{
      "Every method runs on the same recorded states, over levels 0, 3, 6, 9, four bucket counts and five cell sizes, "
      "as "
      "far as it uses them. A cell size is given in units of the automatic one: the largest box of its level at rest + "
      "the tolerance.",
      fmt::format(
          "Detectors run on {} thread{}, from scratch: they forget before each run what they learnt from earlier "
          "frames. All configurations run once to be checked and at most {} times to be timed, in rounds of "
          "shuffled order. A configuration that has taken {:g} ms is left out of further rounds.",
          r.threads, r.threads == 1 ? "" : "s", l.repetitions, l.repeat_ms),
      fmt::format("Budget: a configuration that is predicted to take more than {} pair tests is not run. A hash "
                  "evaluation counts as 32.",
                  grouped(l.budget)),
      "Memory is what a new detector and its list of contacts hold after a frame, correct to some KiB. Detectors keep "
      "their scratch memory, so this is their peak from then on.",
      "`detection.csv` has every row of every state."};
  if (r.quick) items.push_back("This is the quick report: fewer scenes, frames, states and repetitions.");
  page.list(items);
}

// ---- Table 1 ----

/// Returns the mean with the paper's settings: level 3, the scene's own buckets, the automatic cell. Returns nothing if
/// it was not run.
const Mean* with_papers_settings(const std::vector<Mean>& means, const SceneResult& scene, std::size_t method) {
  const auto found = std::ranges::find_if(means, [&](const Mean& m) {
    const Configuration& c = m.configuration;
    const collide::Method& row = method_of(c);
    return c.method == method && (!row.uses_levels || c.settings.levels == paper_level) &&
           (!row.uses_hash || (c.settings.buckets == scene.buckets && c.cell == 1));
  });
  return found == means.end() || !found->not_run.empty() ? nullptr : &*found;
}

std::string detections_per_second(const Mean* m) {
  if (!m) return "not run";
  return whole(1000 / m->ms) + (m->error() > 0 ? fmt::format(" (recall {:.4f})", 1 - m->error()) : "");
}

void add_table_1(Page& page, const DetectionResults& r) {
  Table table;
  for (std::size_t i = 0; i < collide::method_table().size(); ++i) {
    const collide::Method& method = collide::method_table()[i];
    if (method.key == collide::reference_method) continue;
    const std::string_view whose = method.key == collide::paper_method     ? " (the paper's)"
                                   : method.key == collide::default_method ? " (ours)"
                                                                           : "";
    TableRow row{{"method", fmt::format("{}{}", method.name, whose)}};
    for (const SceneResult& s : r.scenes)
      if (std::ranges::count(paper_scenes, s.scene) > 0)
        row.push_back({fmt::format("{}: {} bodies, {} buckets", s.scene, s.states.back().bodies, s.buckets),
                       detections_per_second(with_papers_settings(means(s), s, i))});
    if (row.size() == 1) return;
    table.add(row);
  }
  page.text("## Table 1: frames per second");
  page.text(
      "In the form of the paper's Table 1, measured: detection alone, 1 / its mean time on the recorded states; level "
      "3, "
      "automatic cell size.");
  page.table(table);
  page.text("The first four are the paper's methods. A method without a recall in brackets misses nothing.");
}

// ---- scenes ----

/// Returns of each method the fastest configuration, and the fastest of those that miss least if that is another one.
std::vector<std::size_t> best_rows(const std::vector<Mean>& means) {
  std::vector<std::size_t> best;
  for (std::size_t method = 0; method < collide::method_table().size(); ++method) {
    std::optional<std::size_t> fastest, most_accurate;
    for (std::size_t i = 0; i < means.size(); ++i) {
      const Mean& m = means[i];
      if (m.configuration.method != method || !m.not_run.empty()) continue;
      const auto better = [&](std::size_t other) {
        return std::pair(m.error(), m.ms) < std::pair(means[other].error(), means[other].ms);
      };
      if (!fastest || m.ms < means[*fastest].ms) fastest = i;
      if (!most_accurate || better(*most_accurate)) most_accurate = i;
    }
    if (fastest) best.push_back(*fastest);
    if (most_accurate && most_accurate != fastest) best.push_back(*most_accurate);
  }
  return best;
}

Table best_table(const std::vector<Mean>& all) {
  const std::vector<std::size_t> front = pareto_front(all);
  Table table;
  for (const std::size_t i : best_rows(all)) {
    const Mean& m = all[i];
    const Configuration& c = m.configuration;
    table.add({{"method", method_of(c).name},
               {"level", levels_of(c)},
               {"buckets", buckets_of(c)},
               {"cell", cell_of(c)},
               {"ms median", brief(m.ms)},
               {"ms min", brief(m.min_ms)},
               {"recall", m.error() > 0 ? fmt::format("{:.5f}", 1 - m.error()) : "1"},
               {"precision", fmt::format("{:g}", m.precision())},
               {"pair tests", whole(m.pair_tests)},
               {"hashes", whole(m.hashes)},
               {"boxes", whole(m.boxes)},
               {"memory KiB", whole(static_cast<double>(m.memory) / 1024)},
               {"front", std::ranges::count(front, i) ? "yes" : ""}});
  }
  return table;
}

/// Says what is in the scene, in which states, and which method found the true contacts.
std::string scene_facts(const SceneResult& scene) {
  const StateResult& last = scene.states.back();
  std::string text = fmt::format("Bodies: {}, vertices: {}", grouped(last.bodies), grouped(last.vertices));
  for (const StateResult& s : scene.states)
    text += fmt::format("; frame {}: {} contacts", s.frame, grouped(s.sweep.true_contacts));
  if (!last.sweep.reference)
    return fmt::format("{}. No method could find the true contacts: {}.", text, last.sweep.stands_in);
  return fmt::format("{}. True contacts by {}{}{}.", text, in_words(*last.sweep.reference),
                     last.sweep.stands_in.empty() ? "" : ", since ", last.sweep.stands_in);
}

std::string over_budget(const std::vector<Mean>& means) {
  std::map<std::size_t, std::pair<int, int>> count;  // by method: not run, all
  for (const Mean& m : means) {
    auto& [not_run, all] = count[m.configuration.method];
    not_run += !m.not_run.empty();
    ++all;
  }
  std::vector<std::string> methods;
  for (const auto& [method, n] : count)
    if (n.first > 0)
      methods.push_back(fmt::format("{}: {} of {}", collide::method_table()[method].name, n.first, n.second));
  if (methods.empty()) return "Nothing was over budget.";
  return fmt::format("Over budget in one state or more: {} configurations.", fmt::join(methods, "; "));
}

}  // namespace

Page detection_page(const DetectionResults& results) {
  Page page;
  add_introduction(page, results);
  add_table_1(page, results);
  page.text("## Scenes: the best of every method");
  page.text(
      "Of each method the fastest configuration, and the fastest of those that miss least if that is another one. "
      "Front: "
      "no other is as fast and as good. Means over the states; recall and precision over all their contacts.");
  for (const SceneResult& scene : results.scenes) {
    const std::vector<Mean> all = means(scene);
    page.text("### {}", scene.name);
    page.text("{}", scene_facts(scene));
    page.table(best_table(all));
    page.text("{}", over_budget(all));
    page.plot(error_against_time(scene));
  }
  add_growth(page, results);
  return page;
}

}  // namespace app
