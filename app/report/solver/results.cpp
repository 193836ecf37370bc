#include "app/report/solver/results.h"

#include <algorithm>
#include <cmath>

namespace app {

bool WorkCurve::reaches(double error) const {
  return std::ranges::any_of(points, [&](const WorkPoint& p) { return !p.blew_up && p.error <= error; });
}

/// The median of the longest run in which each error is clearly less than the one before: what lies beside it is
/// rounding, or too coarse to tell. Two such steps at least, unless one leads as far as the reference is known. What
/// starts in balance has nothing but rounding to show.
std::optional<double> SolverCase::order(const WorkCurve& curve, double bound) const {
  constexpr double most = 0.3, clearly = 0.8;  // R; of the error before
  if (at_rest) return std::nullopt;
  std::vector<double> run, longest;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const WorkPoint &a = curve.points[i - 1], &b = curve.points[i];
    const bool falls = !a.blew_up && !b.blew_up && a.error <= most && b.error < clearly * a.error;
    if (!falls) run.clear();
    if (falls) run.push_back(std::log2(a.error / b.error) / std::log2(double(b.substeps) / a.substeps));
    if (run.size() >= longest.size()) longest = run;
  }
  if (longest.size() < (curve.reaches(known(bound)) ? 1 : 2)) return std::nullopt;
  std::ranges::sort(longest);
  return longest[longest.size() / 2];
}

}  // namespace app
