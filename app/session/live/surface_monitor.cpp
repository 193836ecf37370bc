#include "app/session/live/surface_monitor.h"

#include "app/compare/world_oracle.h"

namespace app::session {

void SurfaceMonitor::exchange(const softbody::BodiesInMotion& world, const compare::Positions& before,
                              std::uint64_t revision, int rests) {
  if (!on) return restart(revision);
  if (auto report = check_.take(); report && report->id >= first_wanted_) keep(std::move(*report));
  if (offered_ == revision || !check_.ready(rests)) return;
  offered_ = revision;
  compare::StepSnapshot snapshot;
  snapshot.id = revision;
  snapshot.frame = world.frame();
  snapshot.before = before;
  const softbody::SimulatedMeshes simulated = world.simulated();
  snapshot.copy(simulated.positions);
  snapshot.surfaces = compare::surfaces_of(world);
  snapshot.contacts.assign(simulated.contacts.begin(), simulated.contacts.end());
  check_.offer(std::move(snapshot));
}

void SurfaceMonitor::restart(std::uint64_t revision) {
  report_ = {};
  sums_ = {};
  offered_ = 0;
  first_wanted_ = revision;
}

/// A step may be checked more than once, with other contacts. Its crossings count once.
void SurfaceMonitor::keep(compare::SurfaceReport report) {
  const bool new_step = report.frame > 0 && (sums_.steps == 0 || report.frame != report_.frame);
  report_ = std::move(report);
  ++reports_;
  if (!new_step || !report_.failure.empty()) return;
  ++sums_.steps;
  sums_.vertices += report_.figures.crossed_vertices;
  sums_.edge_pairs += report_.figures.edge_crossings;
}

}  // namespace app::session
