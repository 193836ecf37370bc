#include "app/report/solver/results.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace app::report {

bool WorkCurve::reaches(double error) const {
  return std::ranges::any_of(points, [&](const WorkPoint& p) { return !p.blew_up && p.error <= error; });
}

const WorkPoint& SolverCase::own(std::string_view integrator) const {
  const auto curve = std::ranges::find(curves, integrator, [](const WorkCurve& c) { return c.integrator->key; });
  assert(curve != curves.end() && curve->own);
  return *curve->own;
}

double SolverCase::allowed() const {
  const WorkPoint& rival = own("semi-implicit-euler");
  return rival.blew_up ? scene.promised : std::max(scene.promised, 2 * rival.error);
}

std::optional<double> SolverCase::order(const WorkCurve& curve, double bound) const {
  if (scene.at_rest) return std::nullopt;
  std::vector<double> row, longest;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const WorkPoint &a = curve.points[i - 1], &b = curve.points[i];
    const bool falls = !a.blew_up && !b.blew_up && a.error <= max_order_error && b.error < clear_fall * a.error;
    if (!falls) row.clear();
    if (falls) row.push_back(std::log2(a.error / b.error) / std::log2(double(b.substeps) / a.substeps));
    if (row.size() >= longest.size()) longest = row;
  }
  if (longest.size() < (curve.reaches(uncertainty(bound)) ? 1 : 2)) return std::nullopt;
  std::ranges::sort(longest);
  const std::size_t n = longest.size();
  return (longest[(n - 1) / 2] + longest[n / 2]) / 2;
}

}  // namespace app::report
