#include "app/report/detection/results.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace app::report {
bool Mean::ran() const {
  return std::ranges::all_of(rows, [](const compare::SweepRow* row) { return row->not_run.empty(); });
}

double Mean::ms() const {
  return mean([](const compare::SweepRow* row) { return row->times.median(); });
}

double Mean::error() const {
  return true_contacts == 0 ? 0 : sum_of(rows, &compare::SweepRow::missed) / static_cast<double>(true_contacts);
}

double Mean::precision() const {
  const double contacts = sum_of(rows, &compare::SweepRow::contacts),
               found = static_cast<double>(true_contacts) - sum_of(rows, &compare::SweepRow::missed);
  return contacts == 0 ? 1 : 1 - (contacts - found) / contacts;
}

std::vector<Mean> means(const SceneResult& scene) {
  assert(!scene.states.empty());
  std::vector<Mean> all;
  for (std::size_t i = 0; i < scene.configurations.size(); ++i) {
    Mean& mean = all.emplace_back(Mean{scene.configurations[i]});
    for (const MeasuredState& state : scene.states) {
      mean.rows.push_back(&state.sweep.rows[i]);
      mean.true_contacts += state.sweep.true_contacts;
    }
  }
  return all;
}

const Mean* find(const std::vector<Mean>& means, std::string_view key, int level,
                 std::optional<std::uint32_t> buckets) {
  const auto found = std::ranges::find_if(means, [&](const Mean& m) {
    const compare::Configuration& c = m.configuration;
    const collide::Method& method = method_of(c);
    return method.key == key && c.cell == 1 && (!method.uses_levels || c.settings.levels == level) &&
           (!method.uses_hash || !buckets || c.settings.buckets == *buckets) && m.ran();
  });
  return found == means.end() ? nullptr : &*found;
}

std::vector<std::size_t> pareto_front(const std::vector<Mean>& means) {
  constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<compare::Tradeoff> points;
  for (const Mean& m : means)
    points.push_back(m.ran() ? compare::Tradeoff{m.ms(), m.error()} : compare::Tradeoff{never, never});
  return pareto_front(points);
}

}  // namespace app::report
