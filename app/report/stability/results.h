#pragma once
// What `report stability` measures, and its table, page and plot.

#include <string>
#include <vector>

#include "app/reference/stability_criteria.h"
#include "app/report/page.h"
#include "softbody/integrate/integrators.h"

namespace app::report {

struct StabilityCell {
  std::size_t integrator, dt;  // indices
  reference::StabilityFigures figures{};
  bool passes() const { return reference::failures(figures).empty(); }
};

/// A case at one stiffness.
struct StabilityRow {
  double stiffness;        // N/m; of a scene from a file the factor to its own
  std::string not_judged;  // why shape, volume and rest are not judged; empty: they are
  std::vector<StabilityCell> cells;
};

struct StabilitySection {
  std::string key, name;
  std::vector<StabilityRow> rows;
};

/// The largest step (s) with which a slightly disturbed ball in free flight keeps its energy for 300 steps.
struct StableStep {
  double stiffness = 0;  // N/m
  double found = 0;
  double predicted = 0;  // the integrator's own bound with its safety factor; infinite if it has none
};
inline constexpr double max_step_tried = 0.1;  // s

/// Returns the largest stable step, up to max_step_tried, to within 10 %. `stiffness`: N/m.
StableStep find_stable_step(const softbody::Integrator& integrator, double stiffness);

struct StabilityResults {
  ReportOptions options{};
  double seconds = 0;       // simulated
  std::vector<double> dts;  // s
  std::vector<const softbody::Integrator*> integrators;
  std::vector<StabilitySection> sections;
  std::vector<std::vector<StableStep>> steps;  // by integrator; empty if not measured
};

/// Returns stability.csv: a row per cell and a row per point of the map of steps. What has no meaning is empty.
Table stability_table(const StabilityResults& results);
Page stability_page(const StabilityResults& results);

}  // namespace app::report
