#include "app/report/detection/results.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace app::report {

std::vector<Mean> means(const SceneResult& scene) {
  assert(!scene.states.empty());
  std::vector<Mean> all;
  for (std::size_t i = 0; i < scene.configurations.size(); ++i) {
    Mean& mean = all.emplace_back(Mean{scene.configurations[i]});
    for (const MeasuredState& state : scene.states) {
      const compare::SweepRow& row = state.sweep.rows[i];
      mean.rows.push_back(&row);
      mean.true_contacts += state.sweep.true_contacts;
      mean.ran = mean.ran && row.not_run.empty();
    }
    if (!mean.ran) continue;
    mean.ms = mean.mean([](const compare::SweepRow* row) { return row->times.median(); });
    const auto true_contacts = double(mean.true_contacts);
    const double contacts = sum_of(mean.rows, &compare::SweepRow::contacts),
                 missed = sum_of(mean.rows, &compare::SweepRow::missed), found = true_contacts - missed;
    if (true_contacts > 0) mean.error = missed / true_contacts;
    if (contacts > 0) mean.precision = 1 - (contacts - found) / contacts;
  }
  return all;
}

const Mean* find(const std::vector<Mean>& means, std::string_view key, int level,
                 std::optional<std::uint32_t> buckets) {
  const auto found = std::ranges::find_if(means, [&](const Mean& m) {
    const compare::Configuration& c = m.configuration;
    const collide::Method& method = method_of(c);
    return method.key == key && is_plain(c, level) &&
           (!method.uses_hash || !buckets || c.settings.buckets == *buckets) && m.ran;
  });
  return found == means.end() ? nullptr : &*found;
}

std::vector<std::size_t> pareto_front(const std::vector<Mean>& means) {
  constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<compare::Tradeoff> points;
  for (const Mean& m : means)
    points.push_back(m.ran ? compare::Tradeoff{m.ms, m.error} : compare::Tradeoff{never, never});
  return pareto_front(points);
}

}  // namespace app::report
