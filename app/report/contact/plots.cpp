#include <algorithm>
#include <cmath>

#include "app/base/text.h"
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
    const std::string block = format("$c%d", number_++);
    script += joined(block, " << EOD\n", points, "EOD\n");
    const bool surface = choice.surface == softbody::ContactSurface::surfaces;
    plot_ += joined(plot_.empty() ? "plot " : ", ", block, " with ", style_,
                    format(" pointtype %d pointsize 1.5 linewidth 2 linecolor rgb ", surface ? 7 : shape(choice)),
                    surface ? "'#000000'" : colour(*collide::find_method(choice.method)), " title ",
                    literal(choice_name(choice)));
  }
  /// Nothing if there was nothing to draw.
  std::string finished() const { return plot_.empty() ? "" : joined(script, plot_, "\n"); }

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
  return joined(plot_style, "unset logscale y\nset yrange [0:*]\nset offsets graph 0, graph 0, graph 0.05, graph 0\n",
                "set title ", literal(title), "\nset xlabel ", literal(x), "\nset ylabel ", literal(y), "\n");
}

Plot depth_against_time(const ContactCase& c) {
  Series series("points");
  series.script = head(joined(c.name, ": the deepest penetration against run time"), "a frame, ms of processor time",
                       "deepest penetration, R");
  for (const ContactTrial& t : c.trials) {
    if (t.not_run.empty() && t.radius > 0) series.add(t.choice, format("%.9g %.9g\n", t.cpu_ms, t.deepest / t.radius));
  }
  return {contact_plot_name(c), joined(c.name, ": left is cheaper, down is truer."), series.finished()};
}

/// The cases from `first` on that are the same impact at other speeds.
Plot passed_against_speed(std::span<const ContactCase> cases, std::size_t choices) {
  const ContactCase& first = cases.front();
  Series series("linespoints");
  series.script = head(joined(first.name, ": what passed through"), "speed, m/s",
                       first.key == "solid" ? "bodies that went through the solid" : "vertices that passed through");
  for (std::size_t i = 0; i < choices; ++i) {
    std::string points;
    for (const ContactCase& c : cases) {
      const ContactTrial& t = c.trials[i];
      const std::size_t passed = first.key == "solid" ? t.through_solids : t.passed;
      if (t.not_run.empty()) points += format("%.9g %zu\n", c.speed, passed);
    }
    series.add(first.trials[i].choice, points);
  }
  return {contact_plot_name(first), joined(first.name, ": 0 is right."), series.finished()};
}

}  // namespace

std::string contact_plot_name(const ContactCase& c) {
  return joined(c.impact ? "contact-impact-" : "contact-time-", c.key);
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
