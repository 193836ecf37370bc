#include <fmt/core.h>

#include "app/base/csv_line.h"
#include "app/report/contact/results.h"

namespace app {
namespace {

void add_header(std::string& text) {
  CsvLine line(text);
  for (const char* name : {"part",
                           "scene",
                           "speed",
                           "contact_surface",
                           "method",
                           "tolerance_ratio",
                           "tolerance",
                           "not_run",
                           "radius",
                           "bodies",
                           "vertices",
                           "frames",
                           "looks",
                           "cpu_ms",
                           "detect_ms",
                           "solve_ms",
                           "penetrations",
                           "missed",
                           "deepest",
                           "mean_depth",
                           "solid_depth",
                           "crossed_vertices",
                           "edge_crossings",
                           "passed",
                           "through_solids",
                           "finite",
                           "asleep",
                           "end_depth",
                           "end_overlapping_pairs",
                           "end_self_intersecting",
                           "jitter",
                           "failures"})
    line.add(std::string_view(name));
}

std::string_view key_of(softbody::ContactSurface surface) {
  for (const softbody::ContactSurfaceInfo& info : softbody::contact_surfaces)
    if (info.value == surface) return info.key;
  return {};
}

/// Surface contact has no use for method and tolerance.
void add_choice(CsvLine& line, const ContactTrial& t) {
  const bool vertices = t.choice.surface == softbody::ContactSurface::vertices;
  line.add(key_of(t.choice.surface));
  line.add(vertices ? t.choice.method : std::string_view());
  line.add_if(vertices, t.choice.tolerance);
  line.add_if(vertices && t.not_run.empty(), t.tolerance);
  line.add(t.not_run);
}

void add_measured(CsvLine& line, const ContactTrial& t) {
  const bool run = t.not_run.empty();
  const bool vertices = t.choice.surface == softbody::ContactSurface::vertices;
  const auto add = [&](auto number) { line.add_if(run, number); };
  const auto count = [&](auto number) { line.add_if(run, static_cast<std::uint64_t>(number)); };
  line.add_if(run && t.radius > 0, t.radius);
  count(t.bodies), count(t.vertices), count(t.frames), count(t.looks);
  add(t.cpu_ms), add(t.detect_ms), add(t.solve_ms);
  count(t.penetrations);
  line.add_if(run && vertices, static_cast<std::uint64_t>(t.missed));
  add(t.deepest), add(t.mean_depth), add(t.solid_depth);
  count(t.crossed_vertices), count(t.edge_crossings), count(t.passed), count(t.through_solids);
  count(t.finite), count(t.asleep);
  add(t.end_depth);
  count(t.overlapping_pairs), count(t.self_intersecting);
  add(t.jitter);
}

void add_row(std::string& text, const ContactCase& c, const ContactTrial& t) {
  CsvLine line(text);
  line.add(std::string_view(c.impact ? "impact" : "scene"));
  line.add(c.key);
  line.add_if(c.impact, c.speed);
  add_choice(line, t);
  add_measured(line, t);
  std::string failures;
  if (t.not_run.empty())
    for (const std::string& f : t.failures()) failures += fmt::format("{}{}", failures.empty() ? "" : "; ", f);
  line.add(failures);
}

}  // namespace

std::string contact_csv(const ContactResults& results) {
  std::string text;
  add_header(text);
  for (const ContactCase& c : results.cases) {
    for (const ContactTrial& t : c.trials) add_row(text, c, t);
  }
  return text;
}

}  // namespace app
