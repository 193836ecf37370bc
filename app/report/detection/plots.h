#pragma once

#include <string>
#include <vector>

#include "app/report/detection/results.h"
#include "app/report/plot.h"

namespace app {

/// The names of the two kinds of plots.
std::string error_plot_name(const SceneResult& scene);
inline constexpr std::string_view growth_plot_name = "cost-bodies";

/// Error against run time for every scene, and cost against bodies.
std::vector<Plot> detection_plots(const DetectionResults& results);

}  // namespace app
