#pragma once
// What a run costs and misses, counted frame by frame while it goes on.

#include <memory>
#include <vector>

#include "app/compare/score.h"
#include "collide/core/workers.h"
#include "collide/oracle/surface_oracle.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::compare {

/// What a run has cost and missed up to a frame.
struct RunTotals {
  int frame = 0;                                // of the world
  int frames = 0;                               // counted, each after its step
  double detect_ms = 0;                         // sum
  std::uint64_t true_contacts = 0, missed = 0;  // sums over the frames
  std::size_t inside = 0, most_inside = 0;      // vertices inside other bodies when last looked, and at most
  double depth = 0, deepest = 0;                // m, of these

  double recall() const { return share(true_contacts - missed, true_contacts); }
};

/// Counts what the method that drives a world costs and misses. Where that method can miss contacts, the exact method
/// finds the true ones at the same positions.
class RunFigures {
 public:
  /// Counts a frame. Call it after each step; frames must ascend. Throws what Detector::detect() throws.
  void add(const softbody::BodiesInMotion& world);
  /// Adds what overlaps in the frame that was counted last, or a little earlier.
  void add(const collide::oracle::SurfaceFigures& figures);
  /// Forgets all frames after this one, because the world goes back, or its bodies have other ids.
  void go_back(int frame);

  const RunTotals& totals() const { return totals_.back(); }
  /// Returns the contacts that the method missed in the last frame, ascending; empty after go_back().
  const std::vector<collide::Contact>& missed() const { return missed_; }

 private:
  std::vector<RunTotals> totals_{{}};  // of nothing, then by frame
  std::vector<collide::Contact> missed_;
  std::unique_ptr<collide::Detector> exact_;  // null until a method can miss contacts
  collide::Workers alone_{1};
  collide::Result truth_;
};

}  // namespace app::compare
