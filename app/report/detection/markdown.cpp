#include "app/report/detection/markdown.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/report/detection/growth.h"
#include "app/report/table.h"

namespace app {
namespace {

std::string in_words(const Configuration& c) {
  std::string text(method_of(c).name);
  if (method_of(c).uses_levels) text += fmt::format(", level {}", levels_of(c));
  if (method_of(c).uses_hash) text += fmt::format(", {} buckets, cell {}", buckets_of(c), cell_of(c));
  return text;
}

// ---- what was done ----

std::string introduction(const DetectionResults& r) {
  const SweepLimits& l = r.limits;
  std::string text = fmt::format(
      "# Collision detection: what every method costs, and what it misses\n\n`{}` makes this report. Its times are of "
      "the machine that it ran on: compare them with one another. Contacts, hashes and boxes are the same on every "
      "machine, as are pair tests, but those of the exact method.\n\n",
      r.command);
  text +=
      "- Every method runs on the same recorded states, over levels 0, 3, 6, 9, four bucket counts and five cell "
      "sizes, as far as it has use for them. A cell size is given in units of the automatic one: the largest box of "
      "its level at rest + the tolerance.\n";
  text += fmt::format(
      "- Detectors run on {} thread{}, from scratch: what they learnt from earlier frames is forgotten before each "
      "run. All configurations run once to be checked and at most {} times to be timed, in rounds of shuffled order; "
      "what has taken {:g} ms is left out of further rounds.\n",
      r.threads, r.threads == 1 ? "" : "s", l.repetitions, l.repeat_ms);
  text += fmt::format(
      "- Budget: a configuration that is predicted to take more than {} pair tests, a hash evaluation counted as 32, "
      "is not run.\n",
      grouped(l.budget));
  text +=
      "- Memory is what a fresh detector and its list of contacts hold after a frame, true to some KiB. Detectors "
      "keep their scratch memory, so that it is their peak from then on.\n"
      "- `detection.csv` has every row of every state.\n";
  if (r.quick) text += "- This is the quick report: fewer scenes, frames, states and repetitions.\n";
  return text + "\n";
}

// ---- Table 1 ----

/// The one with the paper's settings: level 3, the scene's own buckets, the automatic cell.
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
  const std::string rate = whole(1000 / m->ms);
  return m->error() > 0 ? fmt::format("{} (recall {:.4f})", rate, 1 - m->error()) : rate;
}

std::string table_1(const DetectionResults& r) {
  std::vector<const SceneResult*> columns;
  std::vector<std::vector<Mean>> all;
  Cells names{"method"};
  for (const SceneResult& s : r.scenes) {
    if (std::ranges::count(paper_scenes, s.scene) == 0) continue;
    columns.push_back(&s);
    all.push_back(means(s));
    names.push_back(fmt::format("{}: {} bodies, {} buckets", s.scene, s.states.back().bodies, s.buckets));
  }
  if (columns.empty()) return {};
  std::string text = fmt::format(
      "## Table 1: frames per second\n\nIn the form of the paper's Table 1, measured: detection alone, 1 / its mean "
      "time on the recorded states; level 3, automatic cell size.\n\n{}",
      heading(names, 1));
  for (std::size_t method = 0; method < collide::method_table().size(); ++method) {
    if (collide::method_table()[method].key == collide::reference_method) continue;
    Cells cells{std::string(collide::method_table()[method].name)};
    for (std::size_t i = 0; i < columns.size(); ++i)
      cells.push_back(detections_per_second(with_papers_settings(all[i], *columns[i], method)));
    text += line(cells);
  }
  return text + "\nThe first four are the paper's methods. What misses no contact has no recall beside it.\n\n";
}

// ---- scenes ----

/// Of each method the fastest configuration, and the fastest of those that miss least where that is another one.
std::vector<std::size_t> best_rows(const std::vector<Mean>& means) {
  std::vector<std::size_t> best;
  for (std::size_t method = 0; method < collide::method_table().size(); ++method) {
    std::optional<std::size_t> fastest, truest;
    for (std::size_t i = 0; i < means.size(); ++i) {
      const Mean& m = means[i];
      if (m.configuration.method != method || !m.not_run.empty()) continue;
      if (!fastest || m.ms < means[*fastest].ms) fastest = i;
      if (!truest || std::pair(m.error(), m.ms) < std::pair(means[*truest].error(), means[*truest].ms)) truest = i;
    }
    if (fastest) best.push_back(*fastest);
    if (truest && truest != fastest) best.push_back(*truest);
  }
  return best;
}

std::string best_table(const std::vector<Mean>& all) {
  const std::vector<std::size_t> front = pareto_front(all);
  std::string text = heading({"method", "level", "buckets", "cell", "ms median", "ms min", "recall", "precision",
                              "pair tests", "hashes", "boxes", "memory KiB", "front"},
                             1);
  for (const std::size_t i : best_rows(all)) {
    const Mean& m = all[i];
    const Configuration& c = m.configuration;
    text += line({std::string(method_of(c).name), levels_of(c), buckets_of(c), cell_of(c), brief(m.ms),
                  brief(m.least_ms), m.error() > 0 ? fmt::format("{:.5f}", 1 - m.error()) : "1",
                  fmt::format("{:g}", m.precision()), whole(m.pair_tests), whole(m.hashes), whole(m.boxes),
                  whole(static_cast<double>(m.memory) / 1024), std::ranges::count(front, i) ? "yes" : ""});
  }
  return text;
}

/// What is in the scene, in which states, and what they are held against.
std::string scene_facts(const SceneResult& scene) {
  const StateResult& last = scene.states.back();
  std::string text = fmt::format("Bodies: {}, vertices: {}", grouped(last.bodies), grouped(last.vertices));
  for (const StateResult& s : scene.states)
    text += fmt::format("; frame {}: {} contacts", s.frame, grouped(s.sweep.true_contacts));
  if (!last.sweep.reference)
    return fmt::format("{}. No method could find the true contacts: {}.\n", text, last.sweep.stands_in);
  text += fmt::format(". True contacts by {}", in_words(*last.sweep.reference));
  return fmt::format("{}{}{}.\n", text, last.sweep.stands_in.empty() ? "" : ", since ", last.sweep.stands_in);
}

std::string not_run(const std::vector<Mean>& means) {
  std::map<std::size_t, std::pair<int, int>> count;  // by method: not run, all
  for (const Mean& m : means) {
    count[m.configuration.method].first += !m.not_run.empty();
    ++count[m.configuration.method].second;
  }
  std::string text;
  for (const auto& [method, n] : count) {
    if (n.first == 0) continue;
    text += fmt::format("{}{}: {} of {}", text.empty() ? "" : "; ", collide::method_table()[method].name, n.first,
                        n.second);
  }
  if (text.empty()) return "Nothing was over budget.\n";
  return fmt::format("Over budget in one state or more: {} configurations.\n", text);
}

std::string scene_section(const SceneResult& scene, const std::vector<Plot>& plots) {
  const std::vector<Mean> all = means(scene);
  return fmt::format("### {}\n\n{}\n{}\n{}{}\n", scene.name, scene_facts(scene), best_table(all), not_run(all),
                     picture(plots, error_plot_name(scene)));
}

}  // namespace

std::string detection_markdown(const DetectionResults& results, const std::vector<Plot>& plots) {
  std::string text = fmt::format(
      "{}{}## Scenes: the best of every method\n\nOf each method the fastest configuration, and the fastest of those "
      "that miss least if that is another one. Front: no other is as fast and as good. Means over the states; recall "
      "and precision over all their contacts.\n\n",
      introduction(results), table_1(results));
  for (const SceneResult& scene : results.scenes) text += scene_section(scene, plots);
  return text + growth_markdown(results, plots);
}

}  // namespace app
