#include "app/report/detection/plots.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "app/base/text.h"

namespace app {
namespace {

/// Where points without any error lie on an axis that has no 0: below all others, a lane a method, so that they do not
/// hide each other.
class Floor {
 public:
  explicit Floor(const std::vector<Mean>& means) {
    double least = 0.1;
    for (const Mean& m : means) {
      if (m.not_run.empty() && m.error() > 0) least = std::min(least, m.error());
    }
    top_ = std::pow(10, std::floor(std::log10(least)));
  }
  double top() const { return top_; }  // the least error that the axis shows
  double bottom() const { return top_ * std::pow(step, static_cast<double>(collide::method_table().size()) + 1); }
  double lane(const Mean& m) const { return top_ * std::pow(step, 1.0 + static_cast<double>(m.configuration.method)); }
  double middle() const { return std::sqrt(top_ * bottom()); }
  double height(const Mean& m) const { return m.error() > 0 ? m.error() : lane(m); }

 private:
  static constexpr double step = 0.7;
  double top_;
};

std::string error_axis(const Floor& floor) {
  std::string script = fmt::format("set yrange [{:g}:1.5]\n", floor.bottom());
  script += fmt::format(
      "set object 1 rectangle from graph 0, first {:g} to graph 1, first {:g} behind fillcolor '#eef4ee' fillstyle "
      "solid noborder\n",
      floor.bottom(), floor.top());
  script += "set ytics (";
  for (double tick = 1; tick > 0.99 * floor.top(); tick /= 10) script += fmt::format("'{:g}' {:g}, ", tick, tick);
  return script + fmt::format("'0' {:g})\n", floor.middle());
}

void add_front(std::string& script, const std::vector<Mean>& means, const Floor& floor) {
  script += "$front << EOD\n";
  for (const std::size_t i : pareto_front(means))
    script += fmt::format("{:.9g} {:.9g}\n", means[i].ms, floor.height(means[i]));
  script += "EOD\n";
}

/// Points that look alike: those of a method and, where it has levels, of one level.
struct Marker {
  std::size_t method;
  std::optional<int> level;

  bool covers(const Configuration& c) const { return c.method == method && (!level || c.settings.levels == *level); }
  std::string title() const {
    const std::string_view name = collide::method_table()[method].name;
    return level ? fmt::format("{}, level {}", name, *level) : std::string(name);
  }
  /// Disc, square, triangle, triangle upside down.
  int shape() const {
    constexpr std::array shapes{7, 5, 9, 11};
    return level ? shapes[static_cast<std::size_t>(std::ranges::find(sweep_levels, *level) - sweep_levels.begin())] : 7;
  }
};

std::vector<Marker> markers() {
  std::vector<Marker> all;
  for (std::size_t m = 0; m < collide::method_table().size(); ++m) {
    if (!collide::method_table()[m].uses_levels) {
      all.push_back({m, {}});
    } else {
      for (const int level : sweep_levels) all.push_back({m, level});
    }
  }
  return all;
}

/// One data block a marker; returns what plots them.
std::string add_points(std::string& script, const std::vector<Mean>& means, const Floor& floor) {
  std::string plots;
  int number = 0;
  for (const Marker& marker : markers()) {
    std::string points;
    for (const Mean& m : means) {
      if (marker.covers(m.configuration) && m.not_run.empty())
        points += fmt::format("{:.9g} {:.9g}\n", m.ms, floor.height(m));
    }
    if (points.empty()) continue;
    const std::string block = fmt::format("$m{}", number++);
    script += fmt::format("{} << EOD\n{}EOD\n", block, points);
    plots += fmt::format(", {} with points pointtype {} pointsize 0.9 linecolor rgb {} title {}", block, marker.shape(),
                         colour(collide::method_table()[marker.method]), literal(marker.title()));
  }
  return plots;
}

Plot error_against_time(const SceneResult& scene) {
  const std::vector<Mean> all = means(scene);
  const Floor floor(all);
  std::string script = plot_style + error_axis(floor);
  script += fmt::format("set title {}\n", literal(fmt::format("{}: error against run time", scene.name)));
  script += "set xlabel 'detection from scratch, ms a frame'\nset ylabel 'missed share of the true contacts'\n";
  add_front(script, all, floor);
  const std::string points = add_points(script, all, floor);
  script += "plot $front with steps linecolor '#000000' linewidth 1.5 title 'Pareto front'" + points +
            ", $front with points pointtype 6 pointsize 1.5 linewidth 1.5 linecolor '#000000' notitle\n";
  return {error_plot_name(scene),
          "Every configuration that ran on all states of " + scene.name +
              "; down and left is better, the shaded band holds those that miss nothing.",
          script};
}

/// One line of the plot of cost against bodies.
struct GrowthSeries {
  Configuration configuration;
  std::string points;
};

std::vector<GrowthSeries> growth_series(const SceneResult& growth) {
  std::vector<GrowthSeries> all;
  for (const SweepRow& row : growth.states.front().sweep.rows) all.push_back({row.configuration, {}});
  for (const StateResult& state : growth.states) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const SweepRow& row = state.sweep.rows[i];
      if (row.not_run.empty()) all[i].points += fmt::format("{} {:.9g}\n", state.bodies, row.times.median());
    }
  }
  std::erase_if(all, [](const GrowthSeries& s) { return s.points.empty(); });
  return all;
}

std::string title(const Configuration& c) {
  const collide::Method& method = method_of(c);
  return method.uses_hash ? fmt::format("{}, {} buckets", method.name, grouped(c.settings.buckets))
                          : std::string(method.name);
}

Plot cost_against_bodies(const SceneResult& growth) {
  std::string script = plot_style, plots;
  script +=
      "set title 'Cost of a frame against the number of bodies'\nset xlabel 'bodies'\n"
      "set ylabel 'detection from scratch, ms a frame'\nset ytics format '%g'\n";
  std::size_t number = 0;
  for (const GrowthSeries& s : growth_series(growth)) {
    const bool dashed =
        method_of(s.configuration).uses_hash && s.configuration.settings.buckets == sweep_buckets.back();
    script += fmt::format("$s{} << EOD\n", number) + s.points + "EOD\n";
    plots +=
        fmt::format("{}$s{} with linespoints pointtype 7 pointsize 0.7 linewidth 2 dashtype {} linecolor rgb {} title ",
                    number ? ", " : "plot ", number, dashed ? 2 : 1, colour(method_of(s.configuration)));
    plots += literal(title(s.configuration));
    ++number;
  }
  return {std::string(growth_plot_name),
          "Cost against bodies, level 3, automatic cell size; what is over budget ends the line.",
          script + plots + "\n"};
}

}  // namespace

std::string error_plot_name(const SceneResult& scene) { return fmt::format("error-time-{}", scene.scene); }

std::vector<Plot> detection_plots(const DetectionResults& results) {
  std::vector<Plot> plots;
  for (const SceneResult& scene : results.scenes) plots.push_back(error_against_time(scene));
  if (!results.growth.states.empty()) plots.push_back(cost_against_bodies(results.growth));
  return plots;
}

}  // namespace app
