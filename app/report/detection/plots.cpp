#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/report/detection/results.h"

namespace app {
namespace {

/// Places points without any error on the logarithmic axis of errors, which has no 0: in a band below all others, with
/// a lane per method, so that they do not hide each other.
class ZeroBand {
 public:
  explicit ZeroBand(const std::vector<Mean>& means) {
    double min = 0.1;
    for (const Mean& m : means)
      if (m.not_run.empty() && m.error() > 0) min = std::min(min, m.error());
    top_ = std::pow(10, std::floor(std::log10(min)));
  }
  Point point(const Mean& m) const { return {m.ms, m.error() > 0 ? m.error() : lane(m.configuration.method)}; }
  /// Returns the axis as gnuplot commands.
  std::string axis() const {
    const double bottom = lane(collide::method_table().size());
    std::string ticks;
    for (double tick = 1; tick > 0.99 * top_; tick /= 10) ticks += fmt::format("'{0:g}' {0:g}, ", tick);
    return fmt::format(
        "set yrange [{0:g}:1.5]\n"
        "set object 1 rectangle from graph 0, first {0:g} to graph 1, first {1:g} behind fillcolor '#eef4ee' fillstyle "
        "solid noborder\n"
        "set ytics ({2}'0' {3:g})\n",
        bottom, top_, ticks, std::sqrt(top_ * bottom));
  }

 private:
  double lane(std::size_t number) const { return top_ * std::pow(0.7, static_cast<double>(number) + 1); }

  double top_;  // the smallest error that the axis shows
};

/// Returns the points of a method, or of one of its levels. Shapes: disc, square, triangle, triangle upside down.
Series series(const std::vector<Mean>& means, const ZeroBand& band, std::size_t method, std::optional<int> level) {
  constexpr std::array shapes{7, 5, 9, 11};
  const collide::Method& row = collide::method_table()[method];
  const auto shape = level ? std::ranges::find(sweep_levels, *level) - sweep_levels.begin() : 0;
  Series series{std::string(row.name) + (level ? fmt::format(", level {}", *level) : ""), colour(row),
                fmt::format("points pointtype {} pointsize 0.9", shapes.at(static_cast<std::size_t>(shape)))};
  for (const Mean& m : means)
    if (m.not_run.empty() && m.configuration.method == method && (!level || m.configuration.settings.levels == *level))
      series.points.push_back(band.point(m));
  return series;
}

}  // namespace

Plot error_against_time(const SceneResult& scene) {
  const std::vector<Mean> all = means(scene);
  const ZeroBand band(all);
  Plot plot{.name = "error-time-" + scene.scene,
            .caption = "Every configuration that ran on all states of " + scene.name +
                       "; down and left is better, the shaded band holds those that miss nothing.",
            .title = scene.name + ": error against run time",
            .x = "detection from scratch, ms a frame",
            .y = "missed share of the true contacts",
            .settings = band.axis()};
  std::vector<Point> front;
  for (const std::size_t i : pareto_front(all)) front.push_back(band.point(all[i]));
  plot.add({"Pareto front", "#000000", "steps linewidth 1.5", front});
  for (std::size_t m = 0; m < collide::method_table().size(); ++m) {
    if (!collide::method_table()[m].uses_levels)
      plot.add(series(all, band, m, {}));
    else
      for (const int level : sweep_levels) plot.add(series(all, band, m, level));
  }
  plot.add({"", "#000000", "points pointtype 6 pointsize 1.5 linewidth 1.5", front});
  return plot;
}

Plot cost_against_bodies(const SceneResult& growth) {
  Plot plot{.name = "cost-bodies",
            .caption = "Cost against bodies, level 3, automatic cell size; a line ends where the budget does.",
            .title = "Cost of a frame against the number of bodies",
            .x = "bodies",
            .y = "detection from scratch, ms a frame",
            .settings = "set ytics format '%g'\n"};
  for (std::size_t i = 0; i < growth.states.front().sweep.rows.size(); ++i) {
    const Configuration& c = growth.states.front().sweep.rows[i].configuration;
    const collide::Method& method = method_of(c);
    const bool dashed = method.uses_hash && c.settings.buckets == sweep_buckets.back();
    Series series{std::string(method.name) + (method.uses_hash ? fmt::format(", {} buckets", buckets_of(c)) : ""),
                  colour(method),
                  fmt::format("linespoints pointtype 7 pointsize 0.7 linewidth 2 dashtype {}", dashed ? 2 : 1)};
    for (const StateResult& state : growth.states)
      if (const SweepRow& row = state.sweep.rows[i]; row.not_run.empty())
        series.points.push_back({static_cast<double>(state.bodies), row.times.median()});
    plot.add(std::move(series));
  }
  return plot;
}

}  // namespace app
