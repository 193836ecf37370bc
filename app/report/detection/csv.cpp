#include "app/report/detection/csv.h"

#include "app/base/csv_line.h"

namespace app {
namespace {

constexpr std::string_view coverage_name(collide::Coverage coverage) {
  switch (coverage) {
    case collide::Coverage::exact:
      return "exact";
    case collide::Coverage::covered:
      return "covered";
    case collide::Coverage::exceeded:
      return "exceeded";
  }
  return "";
}

void add_header(std::string& text) {
  CsvLine line(text);
  for (const char* name : {"part",       "scene",  "frame",    "bodies",        "vertices",    "method",  "levels",
                           "buckets",    "cell",   "cell_x",   "cell_y",        "cell_z",      "not_run", "repetitions",
                           "ms_median",  "ms_min", "contacts", "true_contacts", "missed",      "recall",  "precision",
                           "pair_tests", "hashes", "boxes",    "coverage",      "memory_bytes"})
    line.add(std::string_view(name));
  for (const collide::SkipKind& kind : collide::skip_kinds) line.add("skipped_" + std::string(kind.key));
  line.add(std::string_view("reference"));
}

void add_settings(CsvLine& line, const Configuration& c) {
  const collide::Method& method = method_of(c);
  line.add(method.key);
  line.add_if(method.uses_levels, static_cast<std::uint64_t>(c.settings.levels));
  line.add_if(method.uses_hash, std::uint64_t{c.settings.buckets});
  line.add_if(method.uses_hash, c.cell);
  for (int axis = 0; axis < 3; ++axis) line.add_if(method.uses_hash, double{c.settings.cell_size[axis]});
}

void add_measured(CsvLine& line, const SweepRow& row, const SweepReport& sweep) {
  const bool run = row.not_run.empty();
  const bool scored = run && sweep.reference;
  line.add(row.not_run);
  line.add(std::uint64_t{row.times.ms.size()});
  line.add_if(run, run ? row.times.median() : 0);
  line.add_if(run, run ? row.times.min() : 0);
  line.add_if(run, std::uint64_t{row.contacts});
  line.add_if(sweep.reference.has_value(), std::uint64_t{sweep.true_contacts});
  line.add_if(scored, std::uint64_t{row.missed});
  line.add_if(scored, row.recall);
  line.add_if(scored, row.precision);
  line.add_if(run, row.counters.pair_tests);
  line.add_if(run, row.counters.hashes);
  line.add_if(run, row.counters.boxes);
  line.add_if(run, coverage_name(row.coverage));
  line.add_if(run, std::uint64_t{row.memory});
  for (const std::uint64_t skipped : row.skipped) line.add_if(run, skipped);
  line.add_if(sweep.reference.has_value(), sweep.reference ? method_of(*sweep.reference).key : std::string_view());
}

void add_rows(std::string& text, std::string_view part, const SceneResult& scene) {
  for (const StateResult& state : scene.states) {
    for (const SweepRow& row : state.sweep.rows) {
      CsvLine line(text);
      line.add(part);
      line.add(scene.scene);
      for (const std::uint64_t number :
           {static_cast<std::uint64_t>(state.frame), std::uint64_t{state.bodies}, std::uint64_t{state.vertices}})
        line.add(number);
      add_settings(line, row.configuration);
      add_measured(line, row, state.sweep);
    }
  }
}

}  // namespace

std::string detection_csv(const DetectionResults& results) {
  std::string text;
  add_header(text);
  for (const SceneResult& scene : results.scenes) add_rows(text, "sweep", scene);
  add_rows(text, "growth", results.growth);
  return text;
}

}  // namespace app
