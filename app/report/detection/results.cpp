#include "app/report/detection/results.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include <fmt/core.h>

#include "app/base/text.h"

namespace app::report {
namespace {

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

void add(Mean& mean, const compare::SweepRow& row, std::size_t true_contacts, double weight) {
  if (!row.not_run.empty()) mean.not_run = row.not_run;
  if (!mean.not_run.empty()) return;
  mean.ms += weight * row.times.median();
  mean.min_ms += weight * row.times.min();
  mean.pair_tests += weight * static_cast<double>(row.counters.pair_tests);
  mean.hashes += weight * static_cast<double>(row.counters.hashes);
  mean.boxes += weight * static_cast<double>(row.counters.boxes);
  mean.contacts += row.contacts;
  mean.missed += row.missed;
  mean.true_contacts += true_contacts;
  mean.memory = std::max(mean.memory, row.memory);
}

}  // namespace

double Mean::error() const { return share(missed, true_contacts); }

double Mean::precision() const { return 1 - share(contacts - (true_contacts - missed), contacts); }

std::vector<Mean> means(const SceneResult& scene) {
  assert(!scene.states.empty());
  std::vector<Mean> all;
  for (const compare::SweepRow& row : scene.states.front().sweep.rows)
    all.emplace_back().configuration = row.configuration;
  const double weight = 1.0 / static_cast<double>(scene.states.size());
  for (const StateResult& state : scene.states) {
    for (std::size_t i = 0; i < all.size(); ++i) add(all[i], state.sweep.rows[i], state.sweep.true_contacts, weight);
  }
  return all;
}

std::vector<std::size_t> pareto_front(const std::vector<Mean>& means) {
  constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<compare::Tradeoff> points;
  for (const Mean& m : means)
    points.push_back(m.not_run.empty() ? compare::Tradeoff{m.ms, m.error()} : compare::Tradeoff{never, never});
  return pareto_front(points);
}

std::string levels_of(const compare::Configuration& c) {
  return method_of(c).uses_levels ? std::to_string(c.settings.levels) : "";
}
std::string buckets_of(const compare::Configuration& c) {
  return method_of(c).uses_hash ? grouped(c.settings.buckets) : "";
}
std::string cell_of(const compare::Configuration& c) {
  return method_of(c).uses_hash ? fmt::format("x {:g}", c.cell) : "";
}

}  // namespace app::report
