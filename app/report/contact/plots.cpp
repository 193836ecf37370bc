#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/report/contact/results.h"

namespace app {
namespace {

/// Data blocks $c0, $c1, ..., one a choice, and what plots them: the methods' colours, black for surface contact, and a
/// shape a tolerance.
class Series {
 public:
  explicit Series(std::string_view style) : style_(style) {}

  void add(const ContactChoice& choice, const std::string& points) {
    if (points.empty()) return;
    const std::string block = fmt::format("$c{}", number_++);
    script += fmt::format("{} << EOD\n{}EOD\n", block, points);
    const bool surface = choice.surface == softbody::ContactSurface::surfaces;
    plot_ +=
        fmt::format("{}{} with {} pointtype {} pointsize 1.5 linewidth 2 linecolor rgb {} title {}",
                    plot_.empty() ? "plot " : ", ", block, style_, surface ? 7 : shape(choice),
                    surface ? "'#000000'" : colour(*collide::find_method(choice.method)), literal(choice_name(choice)));
  }
  /// Nothing if there was nothing to draw.
  std::string finished() const { return plot_.empty() ? "" : fmt::format("{}{}\n", script, plot_); }

  std::string script;

 private:
  static int shape(const ContactChoice& choice) {
    return choice.tolerance < 0.5 ? 9 : choice.tolerance < 1 ? 11 : choice.tolerance > 1 ? 13 : 5;
  }
  std::string_view style_;
  std::string plot_;
  int number_ = 0;
};

std::string head(std::string_view title, std::string_view x, std::string_view y) {
  return fmt::format(
      "{}unset logscale y\nset yrange [0:*]\nset offsets graph 0, graph 0, graph 0.05, graph 0\nset title {}\nset "
      "xlabel {}\nset ylabel {}\n",
      plot_style, literal(title), literal(x), literal(y));
}

Plot depth_against_time(const ContactCase& c) {
  Series series("points");
  series.script = head(fmt::format("{}: the deepest penetration against run time", c.name),
                       "a frame, ms of processor time", "deepest penetration, R");
  for (const ContactTrial& t : c.trials) {
    if (t.not_run.empty() && t.radius > 0)
      series.add(t.choice, fmt::format("{:.9g} {:.9g}\n", t.cpu_ms, t.deepest / t.radius));
  }
  return {contact_plot_name(c), fmt::format("{}: left is cheaper, down is truer.", c.name), series.finished()};
}

/// The cases from `first` on that are the same impact at other speeds.
Plot passed_against_speed(std::span<const ContactCase> cases, std::size_t choices) {
  const ContactCase& first = cases.front();
  Series series("linespoints");
  series.script = head(fmt::format("{}: what passed through", first.name), "speed, m/s",
                       first.key == "solid" ? "bodies that went through the solid" : "vertices that passed through");
  for (std::size_t i = 0; i < choices; ++i) {
    std::string points;
    for (const ContactCase& c : cases) {
      const ContactTrial& t = c.trials[i];
      const std::size_t passed = first.key == "solid" ? t.through_solids : t.passed;
      if (t.not_run.empty()) points += fmt::format("{:.9g} {}\n", c.speed, passed);
    }
    series.add(first.trials[i].choice, points);
  }
  return {contact_plot_name(first), fmt::format("{}: 0 is right.", first.name), series.finished()};
}

}  // namespace

std::string contact_plot_name(const ContactCase& c) {
  return fmt::format("{}{}", c.impact ? "contact-impact-" : "contact-time-", c.key);
}

std::vector<Plot> contact_plots(const ContactResults& results) {
  std::vector<Plot> plots;
  for (auto c = results.cases.begin(); c != results.cases.end();) {
    auto end = c + 1;
    while (c->impact && end != results.cases.end() && end->key == c->key) ++end;
    plots.push_back(c->impact ? passed_against_speed({c, end}, results.choices.size()) : depth_against_time(*c));
    c = end;
  }
  std::erase_if(plots, [](const Plot& p) { return p.script.empty(); });
  return plots;
}

}  // namespace app
