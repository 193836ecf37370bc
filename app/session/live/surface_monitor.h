#pragma once
// Checks the surfaces of the world on the screen, step by step, beside it.

#include "app/compare/surface_check.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::session {

/// What passed through surfaces, summed over all steps checked since the start.
struct CrossingSums {
  int steps = 0;
  std::size_t vertices = 0, edge_pairs = 0;
};

class SurfaceMonitor {
 public:
  bool on = false;

  /// Takes the report that is ready, if any, and offers the present state unless it was offered before. before:
  /// positions before the last step; revision: ascending number of the state; rests: see Background::ready().
  void exchange(const softbody::BodiesInMotion& world, const compare::Positions& before, std::uint64_t revision,
                int rests);
  /// Returns true if exchange() must be called again, though the world stands still.
  bool awaits_report(std::uint64_t revision) const { return on && (offered_ != revision || check_.has_work()); }
  /// Starts anew. Reports of states before this revision will be dropped.
  void restart(std::uint64_t revision);

  /// Returns the report of a state that is a few frames old. Its vertices still exist.
  const compare::SurfaceReport& report() const { return report_; }
  /// Returns the number of reports so far, which tells when there is a new one.
  std::uint64_t reports() const { return reports_; }
  const CrossingSums& sums() const { return sums_; }

 private:
  void keep(compare::SurfaceReport report);

  compare::SurfaceReport report_;
  CrossingSums sums_;
  std::uint64_t offered_ = 0, first_wanted_ = 0, reports_ = 0;
  Background<compare::SurfaceCheck> check_;
};

}  // namespace app::session
