#include "tests/bench/report.h"

#include <cstdio>
#include <iostream>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/base/table.h"

namespace bench {
namespace {

double ns_a_vertex(const Measured& m, const Row& row) {
  return row.median_ms * 1e6 / m.course.state->bodies.vertex_count();
}
double ratio(const Measured& m, const Row& row) { return row.median_ms / m.rows.front().median_ms; }
double ratio_of_minimums(const Measured& m, const Row& row) { return row.min_ms / m.rows.front().min_ms; }

}  // namespace

void print_table(const Measured& m) {
  const State& state = *m.course.state;
  std::printf("%s: %u bodies, %u vertices, tolerance %.3g %s, %zu contacts, %.4f %s a frame, threads: %d\n",
              state.key.c_str(), state.bodies.count(), state.bodies.vertex_count(), double(m.course.tolerance),
              state.unit_name.c_str(), m.contacts, mean_displacement(state) / state.unit, state.unit_name.c_str(),
              m.course.threads);
  std::printf("  %-42s %10s %10s %11s %8s %10s\n", "", "median ms", "min ms", "ns a vertex", "ratio", "of minimums");
  for (const Row& row : m.rows)
    std::printf("  %-42.*s %10.3f %10.3f %11.2f %8.2f %10.2f\n", int(row.candidate->name.size()),
                row.candidate->name.data(), row.median_ms, row.min_ms, ns_a_vertex(m, row), ratio(m, row),
                ratio_of_minimums(m, row));
  std::fflush(stdout);
}

void print_csv(const std::vector<Measured>& all) {
  app::Table table;
  for (const Measured& m : all) {
    app::TableRow row{{m.course.state->radius.empty() ? "state, tolerance in m" : "state, tolerance in mean edges",
                       fmt::format("{}, {:g}", m.course.state->key, m.course.tolerance)},
                      {"exact, ms", app::brief(m.rows.front().median_ms)}};
    for (const Row& of : std::span(m.rows).subspan(1))
      row.push_back({std::string(of.candidate->key), app::brief(ratio(m, of), 2)});
    table.add(row);
  }
  std::cout << table.csv();
}

void print_json(const std::vector<Measured>& all) {
  using Json = nlohmann::ordered_json;
  Json runs = Json::array();
  for (const Measured& m : all) {
    const State& state = *m.course.state;
    Json rows = Json::array();
    for (const Row& row : m.rows)
      rows.push_back({{"key", row.candidate->key},
                      {"ms", {{"median", row.median_ms}, {"min", row.min_ms}}},
                      {"ns_per_vertex", ns_a_vertex(m, row)},
                      {"ratio", ratio(m, row)},
                      {"ratio_of_minimums", ratio_of_minimums(m, row)}});
    runs.push_back({{"state", state.key},
                    {"bodies", state.bodies.count()},
                    {"vertices", state.bodies.vertex_count()},
                    {"frames", state.frames.size()},
                    {"unit_m", state.unit},
                    {"motion", mean_displacement(state) / state.unit},
                    {"tolerance", m.course.tolerance},
                    {"threads", m.course.threads},
                    {"contacts", m.contacts},
                    {"candidates", rows}});
  }
  std::cout << Json{{"mean_edge", mean_edge}, {"runs", runs}}.dump() << '\n';
}

}  // namespace bench
