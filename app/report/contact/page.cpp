#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/report/contact/results.h"
#include "app/report/sums.h"

namespace app::report {

std::string choice_name(const ContactChoice& choice) {
  if (choice.surface == softbody::ContactSurface::surfaces) return "Surface";
  return fmt::format("Vertex-vertex, {}, x {:g}", choice.method == collide::paper_method ? "literal" : "exact",
                     choice.tolerance);
}

// ---- the table of figures ----

Table contact_table(const ContactResults& results) {
  Table table;
  for (const ContactCase& c : results.cases)
    for (const ContactTrial& t : c.trials) {
      const bool run = t.was_run();
      const bool vertices =
          t.choice.surface == softbody::ContactSurface::vertices;  // else it has no method and tolerance
      table.add({
          {"part", c.speed ? "impact" : "scene"},
          {"scene", c.scene.key},
          {"speed", c.speed},
          {"contact_surface", softbody::contact_surfaces[std::size_t(t.choice.surface)].key},
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
          {"failures", when(run, joined(t.failures(), "; "))},
      });
    }
  return table;
}

namespace {

// ---- plots ----

/// Series have the methods' colours, black for surface contact, and a shape per tolerance.
Series series(const ContactChoice& choice, std::string_view lines, std::vector<Point> points) {
  const bool surface = choice.surface == softbody::ContactSurface::surfaces;
  const double x = choice.tolerance;
  const int shape = surface ? 7 : x < 0.5 ? 9 : x < 1 ? 11 : x > 1 ? 13 : 5;
  return {choice_name(choice), surface ? "#000000" : colour(*collide::find_method(choice.method)),
          fmt::format("{} pointtype {} pointsize 1.5 linewidth 2", lines, shape), std::move(points)};
}

Plot passed_against_speed(const Page& page, std::span<const ContactCase> cases) {
  assert(!cases.empty());
  const ContactCase& first = cases.front();
  const bool solid = first.scene.key == "solid";
  Plot plot =
      page.plot_of("passed against speed", "contact-impact-" + first.scene.key, fmt::arg("impact", first.scene.name),
                   fmt::arg("what", solid ? "bodies that went through the solid" : "vertices that passed through"));
  for (std::size_t i = 0; i < first.trials.size(); ++i) {
    std::vector<Point> points;
    for (const ContactCase& c : cases) {
      const ContactTrial& t = c.trials[i];
      if (t.was_run()) points.push_back({*c.speed, double(solid ? t.through_solids : t.passed)});
    }
    plot.add(series(first.trials[i].choice, "linespoints", std::move(points)));
  }
  return plot;
}

// ---- the page ----

std::string missed_share(double missed, double penetrations, const ContactChoice& choice) {
  if (choice.surface == softbody::ContactSurface::surfaces || penetrations == 0) return "";
  return fmt::format("{:.1f} %", 100 * missed / penetrations);
}

std::string verdict(const ContactTrial& t, std::string_view in_order = "ok") {
  const std::vector<std::string> failures = t.failures();
  return failures.empty() ? std::string(in_order) : joined(failures, "; ");
}

// ---- all scenes ----

/// Returns a row per choice, over all scenes in which every choice was run.
Table overview(const ContactResults& r) {
  Table table;
  for (std::size_t i = 0; i < r.choices.size(); ++i) {
    std::vector<ContactTrial> trials;
    for (const ContactCase& c : r.cases)
      if (!c.speed && std::ranges::all_of(c.trials, &ContactTrial::was_run)) trials.push_back(c.trials[i]);
    using Trial = const ContactTrial&;
    const double failing = sum_of(trials, [](Trial t) { return !t.failures().empty(); }),
                 penetrations = sum_of(trials, &ContactTrial::penetrations),
                 depths = sum_of(trials, [](Trial t) { return double(t.penetrations) * t.in_radii(t.mean_depth); });
    table.add({{"contact", choice_name(r.choices[i])},
               {"scenes that fail", fmt::format("{} of {}", whole(failing), trials.size())},
               {"penetrating", whole(penetrations)},
               {"missed", missed_share(sum_of(trials, &ContactTrial::missed), penetrations, r.choices[i])},
               {"deepest, R", brief(max_of(trials, [](Trial t) { return t.in_radii(t.deepest); }))},
               {"mean, R", brief(depths / std::max(penetrations, 1.0))},
               {"at the end, R", brief(max_of(trials, [](Trial t) { return t.in_radii(t.end_depth); }))},
               {"passed", whole(sum_of(trials, &ContactTrial::passed))},
               {"through a solid", whole(sum_of(trials, &ContactTrial::through_solids))},
               {"awake", whole(sum_of(trials, [](Trial t) { return t.settles && !t.asleep; }))},
               {"jitter, mm/s", brief(1e3 * max_of(trials, &ContactTrial::jitter))},
               {"ms", brief(sum_of(trials, &ContactTrial::cpu_ms))}});
  }
  return table;
}

/// Surface contact beside vertex-vertex contact by an exact detector at the scene's own tolerance.
Table side_by_side(const ContactResults& r) {
  const auto exact = std::ranges::find_if(r.choices, [](const ContactChoice& c) {
    return c.surface == softbody::ContactSurface::vertices && c.method == collide::default_method && c.tolerance == 1;
  });
  Table table;
  for (const ContactCase& c : r.cases) {
    if (c.speed || std::ranges::none_of(c.trials, &ContactTrial::was_run)) continue;
    const ContactTrial &surface = c.trials.front(), &other = c.trials[std::size_t(exact - r.choices.begin())];
    const bool run = other.was_run();
    table.add({{"scene", fmt::format("`{}`", c.scene.key)},
               {"surface contact", verdict(surface, surface.asleep ? "nothing passed, all asleep" : "nothing passed")},
               {"ms", when(surface.was_run(), brief(surface.cpu_ms, 2))},
               {"vertex-vertex: passed", run ? grouped(other.passed) : other.not_run},
               {"deepest, mm", when(run && other.radius > 0, whole(1e3 * other.deepest))},
               {"ms", when(run, brief(other.cpu_ms, 2))}});
  }
  return table;
}

// ---- scenes and impacts ----

void add_scene(Page& page, const ContactCase& c) {
  page.text("### {}", c.scene.name);
  if (std::ranges::none_of(c.trials, &ContactTrial::was_run))
    return page.text("Not run: {}.", c.trials.front().not_run);
  Table table;
  Plot plot = page.plot_of("depth against time", "contact-time-" + c.scene.key, fmt::arg("scene", c.scene.name));
  for (const ContactTrial& t : c.trials) {
    const bool run = t.was_run();
    if (run && t.radius > 0) plot.add(series(t.choice, "points", {{t.cpu_ms, t.deepest / t.radius}}));
    const auto in_radii = [&](double depth) { return when(run && t.radius > 0, brief(t.in_radii(depth))); };
    table.add({{"contact", choice_name(t.choice)},
               {"penetrating", when(run, brief(double(t.penetrations) / std::max(t.looks, 1)))},
               {"missed", when(run, missed_share(double(t.missed), double(t.penetrations), t.choice))},
               {"deepest, R", in_radii(t.deepest)},
               {"mean, R", in_radii(t.mean_depth)},
               {"at the end, R", in_radii(t.end_depth)},
               {"passed", when(run, grouped(t.passed))},
               {"solid depth, mm", when(run, brief(1e3 * t.solid_depth))},
               {"jitter, mm/s", when(run, brief(1e3 * t.jitter))},
               {"ms", when(run, brief(t.cpu_ms))},
               {"verdict", verdict(t)}});
  }
  page.table(table);
  page.plot(std::move(plot));
}

/// A row per choice, a column per speed.
void add_impact(Page& page, std::span<const ContactCase> cases) {
  page.text("### {}", cases.front().scene.name);
  Table table;
  for (std::size_t i = 0; i < cases.front().trials.size(); ++i) {
    TableRow row{{"contact", choice_name(cases.front().trials[i].choice)}};
    for (const ContactCase& c : cases) row.push_back({fmt::format("{:g} m/s", *c.speed), verdict(c.trials[i])});
    table.add(row);
  }
  page.table(table, 1 + cases.size());
  page.plot(passed_against_speed(page, cases));
}

}  // namespace

Page contact_page(const ContactResults& results) {
  Page page(results.options);
  page.introduce(fmt::arg("stride", results.limits.stride), fmt::arg("depth", ContactTrial::depth_bound),
                 fmt::arg("frames", results.limits.frames), fmt::arg("budget", grouped(results.vertex_frames)),
                 fmt::arg("seconds", results.limits.seconds));
  TimedParts timed;
  for (const ContactCase& c : results.cases)
    for (const ContactTrial& trial : c.trials) timed += trial.timed;
  page.warn_if_busy(timed);
  page.add("scenes");
  page.table(overview(results));
  if (const Table table = side_by_side(results); !table.empty()) {
    page.text("Surface contact, and vertex-vertex contact by an exact detector at the scene's own tolerance:");
    page.table(table, 2);
  }
  page.text("## Scenes");
  bool impacts = false;
  for (const auto& cases : groups_of(results.cases, [](const ContactCase& c) { return c.scene.key; })) {
    if (!cases.front().speed) {
      add_scene(page, cases.front());
      continue;
    }
    if (!std::exchange(impacts, true)) page.text("## Impacts");
    add_impact(page, cases);
  }
  return page;
}

}  // namespace app::report
