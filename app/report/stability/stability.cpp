#include <algorithm>
#include <array>
#include <span>

#include "app/base/usage_error.h"
#include "app/files/output_file.h"
#include "app/report/files.h"
#include "app/report/stability/results.h"

namespace app::report {
namespace {

constexpr std::array stiffnesses{1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8};  // N/m
constexpr std::array factors{1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5};    // times a scene's own
constexpr std::array quick_stiffnesses{1e1, 1e4, 1e8};
constexpr std::array quick_factors{1e-1, 1e0, 1e3};
constexpr std::array quick_cases{"rest", "flattened", "impact-100"};

void add_rows(StabilityResults& r, const StabilityCase& of, std::span<const double> values) {
  for (const double stiffness : values) {
    StabilityRow& row = r.rows.emplace_back(StabilityRow{of, stiffness});
    for (std::size_t i = 0; i < r.integrators.size(); ++i)
      for (std::size_t dt = 0; dt < r.dts.size(); ++dt) row.cells.push_back({i, dt});
  }
}

StabilityResults planned(const ReportOptions& options) {
  const bool quick = options.quick;
  StabilityResults r{.options = options, .seconds = quick ? 1.0 : 2.0, .dts = {1.0 / 30, 1.0 / 60, 1.0 / 240}};
  for (const softbody::Integrator& i : softbody::integrators()) r.integrators.push_back(&i);
  if (options.scene) {
    const softbody::Scene scene = chosen_scenes(options).front();
    if (scene.bodies.empty()) throw UsageError("scene '" + scene.key + "': no body to judge; add a [[body]]");
    add_rows(r, {scene.key, scene.name, [scene](double factor) { return scaled(scene, factor); }},
             quick ? std::span<const double>(quick_factors) : factors);
    return r;
  }
  for (const StabilityCase& c : stability_cases())
    if (!quick || std::ranges::count(quick_cases, c.key) > 0)
      add_rows(r, c, quick ? std::span<const double>(quick_stiffnesses) : stiffnesses);
  return r;
}

}  // namespace

void report_stability(const ReportOptions& options) {
  StabilityResults r = planned(options);
  files::prepare_folder(options.out);
  const auto for_each = [&](const std::string& what, std::size_t count, const std::function<void(std::size_t)>& task) {
    run_in_parallel(
        options, count, [&](std::size_t i) { return what + " " + std::to_string(i + 1); }, task);
  };
  for_each("reference", r.rows.size(), [&](std::size_t i) {
    StabilityRow& row = r.rows[i];
    try {
      row.start = prepare(row.make(row.stiffness), r.seconds);
      find_reference(row.start, options.quick ? 15'000 : 100'000);
    } catch (const softbody::SceneError& error) {
      for (StabilityCell& cell : row.cells) cell.figures.refused = error.what();
    }
  });
  // In this order the expensive cells, those of stiff springs and short frames, are not all at the end.
  const std::size_t cells = r.integrators.size() * r.dts.size();
  for_each("cell", r.rows.size() * cells, [&](std::size_t i) {
    const StabilityRow& row = r.rows[i / cells];
    StabilityCell& cell = r.rows[i / cells].cells[i % cells];
    if (cell.figures.refused.empty())
      cell.figures = run_cell(row.start, *r.integrators[cell.integrator], r.dts[cell.dt]);
  });
  if (!options.scene) {
    const auto ks = options.quick ? std::span<const double>(quick_stiffnesses) : stiffnesses;
    r.steps.assign(r.integrators.size(), std::vector<StableStep>(ks.size()));
    for_each("largest step", ks.size() * r.integrators.size(), [&](std::size_t i) {
      const std::size_t which = i / ks.size(), k = i % ks.size();
      r.steps[which][k] = find_stable_step(*r.integrators[which], ks[k]);
    });
  }
  write_report(options, stability_table(r), "stability.md", stability_page(r));
}

}  // namespace app::report
