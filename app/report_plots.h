#pragma once

#include <string>
#include <vector>

#include "app/report_results.h"

namespace app {

/// A picture to be drawn.
struct Plot {
  std::string name;     // of its files, without the ending
  std::string caption;  // one sentence: what is to be seen
  std::string script;   // for draw()
};

/// The names of the two kinds of plots.
std::string error_plot_name(const SceneResult& scene);
inline constexpr std::string_view growth_plot_name = "cost-bodies";

/// Error against run time for every scene, and cost against bodies.
std::vector<Plot> detection_plots(const DetectionResults& results);

}  // namespace app
