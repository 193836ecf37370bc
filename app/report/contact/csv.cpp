#include <algorithm>

#include <fmt/ranges.h>

#include "app/report/contact/results.h"

namespace app {
namespace {

std::string_view key_of(softbody::ContactSurface surface) {
  return std::ranges::find(softbody::contact_surfaces, surface, &softbody::ContactSurfaceInfo::value)->key;
}

TableRow row_of(const ContactCase& c, const ContactTrial& t) {
  const bool run = t.not_run.empty();
  const bool vertices = t.choice.surface == softbody::ContactSurface::vertices;  // else it has no method and tolerance
  return {
      {"part", c.impact ? "impact" : "scene"},
      {"scene", c.key},
      {"speed", when(c.impact, c.speed)},
      {"contact_surface", key_of(t.choice.surface)},
      {"method", when(vertices, t.choice.method)},
      {"tolerance_ratio", when(vertices, t.choice.tolerance)},
      {"tolerance", when(vertices && run, t.tolerance)},
      {"not_run", t.not_run},
      {"radius", when(run && t.radius > 0, t.radius)},
      {"bodies", when(run, t.bodies)},
      {"vertices", when(run, t.vertices)},
      {"frames", when(run, t.frames)},
      {"looks", when(run, t.looks)},
      {"cpu_ms", when(run, t.cpu_ms)},
      {"detect_ms", when(run, t.detect_ms)},
      {"solve_ms", when(run, t.solve_ms)},
      {"penetrations", when(run, t.penetrations)},
      {"missed", when(run && vertices, t.missed)},
      {"deepest", when(run, t.deepest)},
      {"mean_depth", when(run, t.mean_depth)},
      {"solid_depth", when(run, t.solid_depth)},
      {"crossed_vertices", when(run, t.crossed_vertices)},
      {"edge_crossings", when(run, t.edge_crossings)},
      {"passed", when(run, t.passed)},
      {"through_solids", when(run, t.through_solids)},
      {"finite", when(run, t.finite)},
      {"asleep", when(run, t.asleep)},
      {"end_depth", when(run, t.end_depth)},
      {"end_overlapping_pairs", when(run, t.overlapping_pairs)},
      {"end_self_intersecting", when(run, t.self_intersecting)},
      {"jitter", when(run, t.jitter)},
      {"failures", when(run, fmt::format("{}", fmt::join(t.failures(), "; ")))},
  };
}

}  // namespace

Table contact_table(const ContactResults& results) {
  Table table;
  for (const ContactCase& c : results.cases)
    for (const ContactTrial& t : c.trials) table.add(row_of(c, t));
  return table;
}

}  // namespace app
