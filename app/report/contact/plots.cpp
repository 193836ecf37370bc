#include <fmt/core.h>

#include "app/report/contact/results.h"

namespace app {
namespace {

constexpr const char* axis_from_zero =
    "unset logscale y\nset yrange [0:*]\nset offsets graph 0, graph 0, graph 0.05, graph 0\n";

/// Series have the methods' colours, black for surface contact, and a shape per tolerance.
Series series(const ContactChoice& choice, std::string_view lines, std::vector<Point> points) {
  const bool surface = choice.surface == softbody::ContactSurface::surfaces;
  const double x = choice.tolerance;
  const int shape = surface ? 7 : x < 0.5 ? 9 : x < 1 ? 11 : x > 1 ? 13 : 5;
  return {choice_name(choice), surface ? "#000000" : colour(*collide::find_method(choice.method)),
          fmt::format("{} pointtype {} pointsize 1.5 linewidth 2", lines, shape), std::move(points)};
}

}  // namespace

Plot depth_against_time(const ContactCase& c) {
  Plot plot{.name = "contact-time-" + c.key,
            .caption = c.name + ": left is cheaper, down is more accurate.",
            .title = c.name + ": the deepest penetration against run time",
            .x = "a frame, ms of processor time",
            .y = "deepest penetration, R",
            .settings = axis_from_zero};
  for (const ContactTrial& t : c.trials)
    if (t.not_run.empty() && t.radius > 0) plot.add(series(t.choice, "points", {{t.cpu_ms, t.deepest / t.radius}}));
  return plot;
}

Plot passed_against_speed(std::span<const ContactCase> cases) {
  const ContactCase& first = cases.front();
  const bool solid = first.key == "solid";
  Plot plot{.name = "contact-impact-" + first.key,
            .caption = first.name + ": 0 is right.",
            .title = first.name + ": what passed through",
            .x = "speed, m/s",
            .y = solid ? "bodies that went through the solid" : "vertices that passed through",
            .settings = axis_from_zero};
  for (std::size_t i = 0; i < first.trials.size(); ++i) {
    std::vector<Point> points;
    for (const ContactCase& c : cases) {
      const ContactTrial& t = c.trials[i];
      if (t.not_run.empty()) points.push_back({c.speed, static_cast<double>(solid ? t.through_solids : t.passed)});
    }
    plot.add(series(first.trials[i].choice, "linespoints", std::move(points)));
  }
  return plot;
}

}  // namespace app
