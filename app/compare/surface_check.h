#pragma once
// What the surface oracle says of one step, copied from the world: what is inside what, what passed through what, and
// which of it the detector's contacts do not show.

#include <stop_token>
#include <string>

#include "app/base/background_worker.h"
#include "app/compare/positions.h"
#include "collide/oracle/surface_oracle.h"

namespace app {

/// One step, copied.
struct StepSnapshot {
  std::uint64_t id = 0;  // the caller's: names the state that was copied
  int frame = 0;         // of the world, after the step
  Positions before, at;  // `before` may lack the last bodies: they have just come, and count as not having moved
  collide::Bodies bodies;
  collide::surface::Surfaces surfaces;
  std::vector<collide::Contact> contacts;  // found by the detector
};

/// Where an overlap was missed, seen from a vertex, so that it can be drawn on bodies that have moved on since.
struct SurfaceMark {
  collide::Index vertex;  // the penetrating one, or an end of the edge
  glm::vec3 offset;       // m, from it to the nearest point of the other surface, or to where the edge pierces the face
  bool piercing;
};

struct SurfaceReport {
  std::uint64_t id = 0;  // of the step; 0: nothing judged yet
  int frame = 0;
  collide::oracle::SurfaceFigures figures;
  std::size_t penetrations = 0;  // vertices inside bodies, once for each body
  std::size_t missed_penetrations = 0, missed_piercings = 0, missed_pairs = 0;  // as in collide::oracle::Missed
  std::vector<SurfaceMark> marks;                                               // of these penetrations and piercings
  std::string failure;                                                          // why there are no figures, else empty
};

/// On the calling thread alone. A stop asked for is heeded between overlaps and crossings; the report is worthless
/// then. Too little memory is told by the report.
SurfaceReport check_surfaces(const StepSnapshot& step, const std::stop_token& stop = {});

struct SurfaceCheckTask {
  using Question = StepSnapshot;
  using Answer = SurfaceReport;
  SurfaceReport answer(const StepSnapshot& step, const std::stop_token& stop) { return check_surfaces(step, stop); }
};
using SurfaceCheckWorker = BackgroundWorker<SurfaceCheckTask>;

}  // namespace app
