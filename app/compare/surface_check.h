#pragma once
// Checks one step, copied from the world, with the surface oracle: what is inside what, what passed through what, and
// where surfaces overlap without a contact that the detector found.

#include <optional>
#include <string>

#include "app/base/background.h"
#include "app/compare/positions.h"
#include "collide/oracle/surface_oracle.h"

namespace app::compare {

/// A copy of one step.
struct StepSnapshot : FrameCopy {
  std::uint64_t id = 0;  // the caller's number of the copied state
  int frame = 0;         // of the world, after the step
  Positions before;      // may lack the last bodies: they have just been added, and count as not moved
  collide::surface::Surfaces surfaces;
  std::vector<collide::Contact> contacts;  // found by the detector
};

/// The place of a missed overlap, relative to a vertex, so that it can be drawn on bodies that have moved on since.
struct SurfaceMark {
  collide::Index vertex;  // the penetrating one, or an end of the piercing edge
  glm::vec3 offset;       // m, from the vertex to the nearest point of the other surface, or to the pierced point
  bool piercing;
  collide::Index body;  // the other one: around the vertex, or of the pierced face
};

struct SurfaceReport {
  std::uint64_t id = 0;  // of the step; 0: nothing was checked yet
  int frame = 0;
  collide::oracle::SurfaceFigures figures;
  std::size_t penetrations = 0;  // vertices inside bodies, counted once for each body
  std::size_t missed_penetrations = 0, missed_piercings = 0, missed_pairs = 0;  // see collide::oracle::Missed
  std::vector<SurfaceMark> marks;  // of the missed penetrations and piercings
  std::string failure;             // why there are no figures, else empty
};

/// Checks a step on one thread, as a task for Background: first its overlaps, then its crossings. The report of a
/// cancelled check is worthless. Too little memory is reported as a failure.
class SurfaceCheck {
 public:
  using Question = StepSnapshot;
  using Answer = SurfaceReport;
  std::optional<SurfaceReport> advance(const StepSnapshot& step, const Background<SurfaceCheck>& background);

 private:
  std::optional<collide::oracle::Overlaps> overlaps_;  // of the step at hand
};

}  // namespace app::compare
