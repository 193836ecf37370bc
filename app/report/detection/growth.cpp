#include "app/report/detection/growth.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/report/table.h"

namespace app {
namespace {

/// "1,264 (0.52)": hashes, and their share of the vertices.
std::string of_vertices(double hashes, double vertices) {
  return fmt::format("{} ({:.2f})", whole(hashes), hashes / vertices);
}

/// Hashes of a scene with the automatic cell: of the vertex hash, then of the boxes' corners by level.
Cells hash_row(const SceneResult& scene) {
  double vertices = 0;  // on average: bodies may arrive between the states
  for (const StateResult& s : scene.states) vertices += static_cast<double>(s.vertices);
  vertices /= static_cast<double>(scene.states.size());
  std::map<std::string_view, std::map<int, std::string>> found;  // by method and level
  for (const Mean& m : means(scene)) {
    const Configuration& c = m.configuration;
    if (m.not_run.empty() && c.cell == 1) found[method_of(c).key][c.settings.levels] = of_vertices(m.hashes, vertices);
  }
  const auto cell = [](const std::map<int, std::string>& levels, auto which) {
    return which == levels.end() ? "not run" : which->second;
  };
  const auto& vertex_hash = found["grid-hash"];
  const auto& corner_hash = found["multi-level-sb"];
  Cells cells{scene.scene, whole(vertices), cell(vertex_hash, vertex_hash.begin())};
  for (const int level : sweep_levels) cells.push_back(cell(corner_hash, corner_hash.find(level)));
  return cells;
}

std::string hash_counts(const DetectionResults& r) {
  Cells names{"scene", "N", "Grid Hash"};
  for (const int level : sweep_levels) names.push_back(fmt::format("8 corners a box, level {}", level));
  std::string text = fmt::format(
      "### Hashes: N vertices against 8 corners a box\n\nHash evaluations a frame, automatic cell size, means over the "
      "states, in brackets as a share of the N vertices. A vertex hash fills its table with N of them; the rest are "
      "the look-ups of all cells within the tolerance, without which it would miss contacts. The eight corners of the "
      "boxes save hashes only where a body has more than eight vertices a box.\n\n{}",
      heading(names, 1));
  for (const SceneResult& scene : r.scenes) text += line(hash_row(scene));
  return text + "\n";
}

/// p of cost ~ bodies^p between the last two states that a configuration ran on; nothing where a cost is 0, or if there
/// are no two.
struct Exponents {
  std::optional<double> hashes, pair_tests, ms;
};

Exponents exponents(const SceneResult& growth, std::size_t row) {
  std::vector<const StateResult*> run;
  for (const StateResult& s : growth.states) {
    if (s.sweep.rows[row].not_run.empty()) run.push_back(&s);
  }
  if (run.size() < 2) return {};
  const StateResult &before = *run[run.size() - 2], &last = *run.back();
  const SweepRow &a = before.sweep.rows[row], &b = last.sweep.rows[row];
  const double bodies = static_cast<double>(last.bodies) / before.bodies;
  const auto p = [&](auto from, auto to) -> std::optional<double> {
    if (!(from > 0 && to > 0)) return std::nullopt;
    return std::log(static_cast<double>(to) / static_cast<double>(from)) / std::log(bodies);
  };
  return {p(a.counters.hashes, b.counters.hashes), p(a.counters.pair_tests, b.counters.pair_tests),
          p(a.times.median(), b.times.median())};
}

/// "1.00 to 1.97": of one exponent over all configurations.
std::string range(const SceneResult& growth, std::optional<double> Exponents::*which) {
  std::optional<double> least, most;
  for (std::size_t i = 0; i < growth.states.front().sweep.rows.size(); ++i) {
    const std::optional<double> p = exponents(growth, i).*which;
    if (!p) continue;
    least = std::min(least.value_or(*p), *p);
    most = std::max(most.value_or(*p), *p);
  }
  return least ? fmt::format("{:.2f} to {:.2f}", *least, *most) : "not known";
}

std::string cost(const SweepRow& row, collide::Index vertices) {
  if (!row.not_run.empty()) return "over budget";
  const double ms = row.times.median();
  return fmt::format("{} ({})", brief(ms), brief(1e6 * ms / std::max(1.0, static_cast<double>(vertices))));
}

std::string growth_table(const SceneResult& growth) {
  Cells names{"method", "buckets"};
  for (const StateResult& s : growth.states) names.push_back(fmt::format("{} bodies", grouped(s.bodies)));
  names.insert(names.end(), {"p of hashes", "p of pair tests", "p of ms"});
  std::string text = heading(names, 1);
  const std::vector<SweepRow>& rows = growth.states.front().sweep.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Configuration& c = rows[i].configuration;
    Cells cells{std::string(method_of(c).name), buckets_of(c)};
    for (const StateResult& s : growth.states) cells.push_back(cost(s.sweep.rows[i], s.vertices));
    const Exponents p = exponents(growth, i);
    for (const auto& value : {p.hashes, p.pair_tests, p.ms})
      cells.push_back(value ? fmt::format("{:.2f}", *value) : "");
    text += line(cells);
  }
  return text;
}

}  // namespace

std::string growth_markdown(const DetectionResults& results, const std::vector<Plot>& plots) {
  const SceneResult& growth = results.growth;
  std::string text = fmt::format(
      "## What §3 of the paper claims, by counts\n\nIt claims O(1) at best and O(N²) at worst, and O(log_n N) hashing "
      "with boxes against O(N) without.\n\n{}",
      hash_counts(results));
  if (growth.states.empty()) return text;
  text += fmt::format(
      "### Growth with the number of bodies\n\nThe bodies nearest to the middle of `{}`, frame {}, the first one "
      "recorded, where the middle is as dense as the rest; level 3, automatic cell size: median ms a frame, in "
      "brackets ns a vertex. p: a cost grows as bodies^p between the last two columns that were run; 0 would be O(1), "
      "1 is linear, 2 quadratic.\n\n",
      growth.scene, growth.states.back().frame);
  text += fmt::format(
      "Every body brings boxes of its own, so that hashing is linear in the number of bodies, whatever the level: p of "
      "hashes is {}. Pair tests, p {}, are quadratic by brute force and where the buckets do not grow with the "
      "bodies.\n\n",
      range(growth, &Exponents::hashes), range(growth, &Exponents::pair_tests));
  return fmt::format("{}{}{}", text, growth_table(growth), picture(plots, growth_plot_name));
}

}  // namespace app
