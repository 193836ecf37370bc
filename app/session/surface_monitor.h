#pragma once
// The true surfaces of the world that is shown, judged step after step on a thread of its own.

#include "app/compare/surface_check.h"
#include "softbody/world.h"

namespace app {

/// What passed through a surface, over all steps judged since the watch began.
struct CrossingSums {
  int steps = 0;
  std::size_t vertices = 0, edge_pairs = 0;
};

class SurfaceMonitor {
 public:
  /// Takes the report that is ready, if any, and offers the present state if it was not yet. before: positions before
  /// the last step; revision: names the state, ascending; rests: as BackgroundWorker::ready().
  void exchange(const softbody::World& world, const Positions& before, std::uint64_t revision, int rests);
  /// Begins anew: nothing is known, and reports of states before this revision are dropped.
  void restart(std::uint64_t revision);

  /// Of a state a few frames old, whose vertices still exist.
  const SurfaceReport& report() const { return report_; }
  /// Counts the reports, so that a new one is noticed.
  std::uint64_t reports() const { return reports_; }
  const CrossingSums& sums() const { return sums_; }

 private:
  void keep(SurfaceReport report);

  SurfaceReport report_;
  CrossingSums sums_;
  std::uint64_t offered_ = 0, first_wanted_ = 0, reports_ = 0;
  SurfaceCheckWorker worker_;
};

}  // namespace app
