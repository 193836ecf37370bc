#include <array>

#include <fmt/core.h>

#include "app/report/detection/results.h"

namespace app {
namespace {

constexpr std::array coverage_names{"exact", "covered", "exceeded"};  // by value

TableRow row_of(std::string_view part, const SceneResult& scene, const StateResult& state, const SweepRow& r) {
  const Configuration& c = r.configuration;
  const collide::Method& method = method_of(c);
  const glm::vec3 cell = c.settings.cell_size;
  const bool run = r.not_run.empty(), known = state.sweep.reference.has_value(), scored = run && known;
  TableRow row{{"part", part},
               {"scene", scene.scene},
               {"frame", state.frame},
               {"bodies", state.bodies},
               {"vertices", state.vertices},
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
               {"ms_min", run ? r.times.least() : TableCell()},
               {"contacts", when(run, r.contacts)},
               {"true_contacts", when(known, state.sweep.true_contacts)},
               {"missed", when(scored, r.missed)},
               {"recall", when(scored, r.recall)},
               {"precision", when(scored, r.precision)},
               {"pair_tests", when(run, r.counters.pair_tests)},
               {"hashes", when(run, r.counters.hashes)},
               {"boxes", when(run, r.counters.boxes)},
               {"coverage", when(run, coverage_names.at(static_cast<std::size_t>(r.coverage)))},
               {"memory_bytes", when(run, r.memory)}};
  for (std::size_t kind = 0; kind < r.skipped.size(); ++kind)
    row.push_back({fmt::format("skipped_{}", collide::skip_kinds[kind].key), when(run, r.skipped[kind])});
  row.push_back({"reference", known ? method_of(*state.sweep.reference).key : TableCell()});
  return row;
}

}  // namespace

Table detection_table(const DetectionResults& results) {
  Table table;
  const auto add = [&](std::string_view part, const SceneResult& scene) {
    for (const StateResult& state : scene.states)
      for (const SweepRow& row : state.sweep.rows) table.add(row_of(part, scene, state, row));
  };
  for (const SceneResult& scene : results.scenes) add("sweep", scene);
  add("growth", results.growth);
  return table;
}

}  // namespace app
