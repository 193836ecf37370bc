// What §3 of the paper claims: hashes by level, and growth with the number of bodies.

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/report/detection/results.h"

namespace app::report {
namespace {

/// Returns the hashes of a scene with the automatic cell: of the vertex hash, then of the boxes' corners by level.
TableRow hash_row(const SceneResult& scene) {
  double vertices = 0;  // on average: bodies may appear between the states
  for (const StateResult& s : scene.states) vertices += static_cast<double>(s.vertices);
  vertices /= static_cast<double>(scene.states.size());
  const std::vector<Mean> all = means(scene);
  const auto hashes = [&](std::string_view method, std::optional<int> level) -> std::string {
    const auto found = std::ranges::find_if(all, [&](const Mean& m) {
      const compare::Configuration& c = m.configuration;
      return m.not_run.empty() && c.cell == 1 && method_of(c).key == method && (!level || c.settings.levels == *level);
    });
    return found == all.end() ? "not run" : fmt::format("{} ({:.2f})", whole(found->hashes), found->hashes / vertices);
  };
  TableRow row{{"scene", scene.scene}, {"N", whole(vertices)}, {"Grid Hash", hashes("grid-hash", std::nullopt)}};
  for (const int level : compare::sweep_levels)
    row.push_back({fmt::format("8 corners per box, level {}", level), hashes(collide::paper_method, level)});
  return row;
}

void add_hash_counts(Page& page, const DetectionResults& r) {
  Table table;
  for (const SceneResult& scene : r.scenes) table.add(hash_row(scene));
  page.add("hashes");
  page.table(table);
}

/// The exponents p of cost ~ bodies^p between the last two states that a configuration ran on. Nothing where a cost is
/// 0, or if there are no two such states.
struct Exponents {
  std::optional<double> hashes, pair_tests, ms;
};

Exponents exponents(const SceneResult& growth, std::size_t row) {
  std::vector<const StateResult*> run;
  for (const StateResult& s : growth.states)
    if (s.sweep.rows[row].not_run.empty()) run.push_back(&s);
  if (run.size() < 2) return {};
  const StateResult &before = *run[run.size() - 2], &last = *run.back();
  const compare::SweepRow &a = before.sweep.rows[row], &b = last.sweep.rows[row];
  const double bodies = static_cast<double>(last.bodies) / before.bodies;
  const auto p = [&](auto from, auto to) -> std::optional<double> {
    if (!(from > 0 && to > 0)) return std::nullopt;
    return std::log(static_cast<double>(to) / static_cast<double>(from)) / std::log(bodies);
  };
  return {p(a.counters.hashes, b.counters.hashes), p(a.counters.pair_tests, b.counters.pair_tests),
          p(a.times.median(), b.times.median())};
}

/// Returns the range of one exponent over all configurations: "1.00 to 1.97".
std::string range(const SceneResult& growth, std::optional<double> Exponents::*which) {
  std::vector<double> all;
  for (std::size_t i = 0; i < growth.states.front().sweep.rows.size(); ++i)
    if (const auto p = exponents(growth, i).*which) all.push_back(*p);
  if (all.empty()) return "not known";
  const auto [min, max] = std::ranges::minmax(all);
  return fmt::format("{:.2f} to {:.2f}", min, max);
}

std::string cost(const compare::SweepRow& row, collide::Index vertices) {
  if (!row.not_run.empty()) return "over budget";
  const double ms = row.times.median();
  return fmt::format("{} ({})", brief(ms), brief(1e6 * ms / std::max(1.0, static_cast<double>(vertices))));
}

Table growth_table(const SceneResult& growth) {
  const auto text = [](std::optional<double> p) { return p ? fmt::format("{:.2f}", *p) : ""; };
  Table table;
  for (std::size_t i = 0; i < growth.states.front().sweep.rows.size(); ++i) {
    const compare::Configuration& c = growth.states.front().sweep.rows[i].configuration;
    TableRow row{{"method", method_of(c).name}, {"buckets", buckets_of(c)}};
    for (const StateResult& s : growth.states)
      row.push_back({fmt::format("{} bodies", grouped(s.bodies)), cost(s.sweep.rows[i], s.vertices)});
    const Exponents p = exponents(growth, i);
    row.push_back({"p of hashes", text(p.hashes)});
    row.push_back({"p of pair tests", text(p.pair_tests)});
    row.push_back({"p of ms", text(p.ms)});
    table.add(row);
  }
  return table;
}

Plot cost_against_bodies(const Page& page, const SceneResult& growth) {
  const bool all_ran = std::ranges::all_of(growth.states, [](const StateResult& state) {
    return std::ranges::all_of(state.sweep.rows, [](const compare::SweepRow& row) { return row.not_run.empty(); });
  });
  Plot plot = page.plot_of("cost against bodies", "cost-bodies",
                           fmt::arg("budget", all_ran ? "" : "; a line ends where the budget does"));
  for (std::size_t i = 0; i < growth.states.front().sweep.rows.size(); ++i) {
    const compare::Configuration& c = growth.states.front().sweep.rows[i].configuration;
    const collide::Method& method = method_of(c);
    const bool dashed = method.uses_hash && c.settings.buckets == compare::sweep_buckets.back();
    Series series{method.name + (method.uses_hash ? fmt::format(", {} buckets", buckets_of(c)) : ""), colour(method),
                  fmt::format("linespoints pointtype {} pointsize 1.1 linewidth 1.5 dashtype {}", point_type(method),
                              dashed ? 2 : 1)};
    for (const StateResult& state : growth.states)
      if (const compare::SweepRow& row = state.sweep.rows[i]; row.not_run.empty())
        series.points.push_back({static_cast<double>(state.bodies), row.times.median()});
    plot.add(std::move(series));
  }
  return plot;
}

}  // namespace

void add_growth(Page& page, const DetectionResults& results) {
  const SceneResult& growth = results.growth;
  add_hash_counts(page, results);
  if (growth.states.empty()) return;
  page.add("growth", fmt::arg("scene", growth.scene), fmt::arg("frame", growth.states.back().frame),
           fmt::arg("hashes", range(growth, &Exponents::hashes)),
           fmt::arg("pair_tests", range(growth, &Exponents::pair_tests)));
  page.table(growth_table(growth));
  page.plot(cost_against_bodies(page, growth));
}

}  // namespace app::report
