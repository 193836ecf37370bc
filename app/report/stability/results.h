#pragma once
// What `report stability` has found, and what it is written as.

#include <string>
#include <vector>

#include "app/reference/stability_criteria.h"
#include "app/report/plot.h"
#include "app/report/stability/step_map.h"

namespace app {

struct StabilityCell {
  std::size_t integrator, dt;  // indices
  StabilityFigures figures{};
  bool passes() const { return failures(figures).empty(); }
};

/// A case at one stiffness.
struct StabilityRow {
  double stiffness;    // N/m; of a scene from a file the factor to its own
  std::string untold;  // why shape, volume and rest are not judged; empty: they are
  std::vector<StabilityCell> cells;
};

struct StabilitySection {
  std::string key, name;
  std::vector<StabilityRow> rows;
};

struct StabilityResults {
  std::string command;
  bool quick = false;
  bool from_file = false;   // a scene of the user's
  double seconds = 0;       // simulated
  std::vector<double> dts;  // s
  std::vector<const softbody::Integrator*> integrators;
  std::vector<StabilitySection> sections;
  std::vector<std::vector<StableStep>> steps;  // an integrator; empty if not asked for
};

/// A row a cell and a row a point of the map, with a header line. What has no meaning is empty.
std::string stability_csv(const StabilityResults& results);
/// The map of the largest stable step.
std::vector<Plot> stability_plots(const StabilityResults& results);
inline constexpr std::string_view stable_step_plot = "stability-steps";
/// plots: those that lie beside it as NAME.svg and NAME.png.
std::string stability_markdown(const StabilityResults& results, const std::vector<Plot>& plots);

}  // namespace app
