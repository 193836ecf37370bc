// What §3 of the paper claims, the hashes by level, and what costs depend on.

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/report/detection/results.h"

namespace app::report {
namespace {

/// Returns the hashes of a scene with the automatic cell: of the vertex hash, then of the boxes' corners by level.
TableRow hash_row(const SceneResult& scene) {
  const double vertices = sum_of(scene.states, [](const MeasuredState& s) { return s.bodies.vertex_count(); }) /
                          double(scene.states.size());  // on average: bodies may appear between the states
  const std::vector<Mean> all = means(scene);
  const auto hashes = [&](std::string_view method, int level) -> std::string {
    const Mean* found = find(all, method, level);
    if (!found) return "not run";
    const double mean = found->mean([](const compare::SweepRow* row) { return row->counters.hashes; });
    return fmt::format("{} ({:.2f})", whole(mean), mean / vertices);
  };
  TableRow row{{"scene", scene.scene}, {"N", whole(vertices)}, {"Grid Hash", hashes("grid-hash", 0)}};
  for (const int level : compare::sweep_levels)
    row.push_back({fmt::format("8 corners per box, level {}", level), hashes(collide::paper_method, level)});
  return row;
}

/// What grows with the number of bodies.
struct Cost {
  const char* exponent;  // its column
  double (*of)(const compare::SweepRow& row);
};
constexpr std::array growing{
    Cost{"p of hashes", [](const compare::SweepRow& r) { return double(r.counters.hashes); }},
    Cost{"p of pair tests", [](const compare::SweepRow& r) { return double(r.counters.pair_tests); }},
    Cost{"p of ms", [](const compare::SweepRow& r) { return r.times.median(); }}};

/// Returns the exponent p of cost ~ bodies^p between the last two states that a configuration ran on. Returns nothing
/// where a cost is 0, or if there are no two such states.
std::optional<double> exponent(const SceneResult& growth, std::size_t configuration, const Cost& cost) {
  std::vector<const MeasuredState*> run;
  for (const MeasuredState& s : growth.states)
    if (s.sweep.rows[configuration].not_run.empty()) run.push_back(&s);
  if (run.size() < 2) return std::nullopt;
  const MeasuredState &before = *run[run.size() - 2], &last = *run.back();
  const double from = cost.of(before.sweep.rows[configuration]), to = cost.of(last.sweep.rows[configuration]);
  if (!(from > 0 && to > 0)) return std::nullopt;
  return std::log(to / from) / std::log(double(last.bodies.count()) / before.bodies.count());
}

/// Returns the range of one exponent over all configurations: "1.00 to 1.97".
std::string range(const SceneResult& growth, const Cost& cost) {
  std::vector<double> all;
  for (std::size_t i = 0; i < growth.configurations.size(); ++i)
    if (const auto p = exponent(growth, i, cost)) all.push_back(*p);
  if (all.empty()) return "not known";
  const auto [min, max] = std::ranges::minmax(all);
  return fmt::format("{:.2f} to {:.2f}", min, max);
}

std::string cost(const compare::SweepRow& row, collide::Index vertices) {
  if (!row.not_run.empty()) return "over budget";
  const double ms = row.times.median();
  return fmt::format("{} ({})", brief(ms), brief(1e6 * ms / std::max(1.0, double(vertices))));
}

/// Returns the costs in each state, and the exponents of some of them.
Table study_table(const SceneResult& study, std::span<const Cost> exponents) {
  Table table;
  for (std::size_t i = 0; i < study.configurations.size(); ++i) {
    const compare::Configuration& c = study.configurations[i];
    TableRow row{{"method", method_of(c).name}, {"buckets", when(method_of(c).uses_hash, grouped(c.settings.buckets))}};
    for (const MeasuredState& s : study.states)
      row.push_back({s.change, cost(s.sweep.rows[i], s.bodies.vertex_count())});
    for (const Cost& of : exponents) {
      const auto p = exponent(study, i, of);
      row.push_back({of.exponent, p ? fmt::format("{:.2f}", *p) : ""});
    }
    table.add(row);
  }
  TableRow contacts{{"method", "Contacts"}};
  for (const MeasuredState& s : study.states) contacts.push_back({s.change, grouped(s.sweep.true_contacts)});
  table.add(contacts);
  return table;
}

Plot cost_against_bodies(const Page& page, const SceneResult& growth) {
  const bool all_ran = std::ranges::all_of(means(growth), &Mean::ran);
  Plot plot = page.plot_of("cost against bodies", "cost-bodies",
                           fmt::arg("budget", all_ran ? "" : "; a line ends where the budget does"));
  for (std::size_t i = 0; i < growth.configurations.size(); ++i) {
    const compare::Configuration& c = growth.configurations[i];
    const collide::Method& method = method_of(c);
    const bool dashed = method.uses_hash && c.settings.buckets == compare::sweep_buckets.back();
    Series series{method.name + (method.uses_hash ? fmt::format(", {} buckets", grouped(c.settings.buckets)) : ""),
                  colour(method),
                  fmt::format("linespoints pointtype {} pointsize 1.1 linewidth 1.5 dashtype {}", point_type(method),
                              dashed ? 2 : 1)};
    for (const MeasuredState& state : growth.states)
      if (const compare::SweepRow& row = state.sweep.rows[i]; row.not_run.empty())
        series.points.push_back({double(state.bodies.count()), row.times.median()});
    plot.add(std::move(series));
  }
  return plot;
}

}  // namespace

void add_studies(Page& page, const DetectionResults& results) {
  Table hashes;
  for (const SceneResult& scene : results.scenes) hashes.add(hash_row(scene));
  page.add("hashes");
  page.table(hashes);
  for (const SceneResult& study : results.studies) {
    const bool growth = study.part == "growth";
    page.add(std::string(study.part), fmt::arg("scene", study.scene), fmt::arg("frame", study.states.back().frame),
             fmt::arg("hashes", range(study, growing[0])), fmt::arg("pair_tests", range(study, growing[1])));
    page.table(study_table(study, growth ? growing : std::span<const Cost>()));
    if (growth) page.plot(cost_against_bodies(page, study));
  }
}

}  // namespace app::report
