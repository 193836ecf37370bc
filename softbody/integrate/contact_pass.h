#pragma once
// Contacts on the velocities of a substep: the true surfaces of bodies first, then solids, then again those surfaces
// that the solids have pushed into each other.

#include <array>
#include <vector>

#include "softbody/contact/solid_contact.h"
#include "softbody/contact/surface_contact.h"
#include "softbody/integrate/batch_shares.h"
#include "softbody/integrate/plan.h"
#include "softbody/integrate/work.h"
#include "softbody/scene/scene.h"
#include "softbody/state/state.h"

namespace softbody {

class ContactPass {
 public:
  /// All of these must outlive this.
  ContactPass(const Scene& scene, State& state, SolidContact& solids, const BatchShares& shares)
      : scene_(scene), state_(state), solids_(solids), shares_(shares) {}

  void set_plan(const Plan& plan);
  /// Sets how many candidates there may be at one time. Searches that find more throw std::length_error.
  void set_max_candidates(const MaxCandidates& max) { max_candidates_ = max; }
  /// Takes the world's list of bodies, which must outlive this.
  void set_vertices(const collide::Bodies& vertices) { vertices_ = &vertices; }
  const collide::Bodies& vertices() const { return *vertices_; }

  void begin_frame() { found_ = 0; }
  /// Wakes sleepers that a body comes near within `seconds` which is faster than twice the speed of sleep: a body that
  /// sleeps through a hit stands like a wall. Returns the work, see SurfaceSearch::work().
  double wake_hit_sleepers(double seconds);
  /// Finds the candidates of surface contact, unless those at hand hold: for the seconds `ahead` at least, of those
  /// that are left of the frame; of bodies that are strained fast, for the seconds `least` only. Returns the work.
  double find(double left, double ahead, double least);
  /// Returns for how many substeps of h seconds the candidates are likely to hold: at least one.
  int covered_substeps(double left, double h) const;

  /// True if the share's bodies may be pushed by surfaces. Then its part of apply() waits for the other threads.
  bool meets_others(const BatchShare& share) const {
    return has_surfaces_ && !surfaces_.candidates().empty() && !share.is_alone;
  }
  /// True if apply() may change velocities of the batch.
  bool may_touch(const BatchShare& share, const Batch& batch) const {
    return meets_others(share) || !solids_.near(batch).empty();
  }
  /// Changes the velocities so that in a step of h from here surfaces do not pass through each other, nor particles
  /// into solids. The velocities of all batches must be there. Needs a barrier after it.
  /// since_start: s, of the substep that has brought the positions here.
  void apply(const BatchShare& share, float h, float since_start = 0);
  /// Does the part of apply() that follows the solve of surfaces.
  void apply_after_surfaces(const BatchShare& share, float h);
  /// Counts a substep that this thread has done.
  void advance(const BatchShare& share, float h);

  bool has_surfaces() const { return has_surfaces_; }
  const SurfaceContact& surfaces() const { return surfaces_; }
  SurfaceContact& surfaces() { return surfaces_; }

 private:
  void apply_solids(const BatchShare& share, float h);
  void keep_overlapping_awake();
  void solve_island(int thread, const SurfaceContact::Island& island, float h);
  collide::Frame world_positions();
  collide::surface::Motion motion(const collide::Frame& now);

  const Scene& scene_;
  State& state_;
  SolidContact& solids_;
  const BatchShares& shares_;
  SurfaceContact surfaces_;
  bool has_surfaces_ = false;
  std::vector<float> since_found_;  // s, as each thread counts them
  MaxCandidates max_candidates_;
  double found_ = 0;  // s before the end of the frame, when the candidates were found; 0: not yet
  const collide::Bodies* vertices_ = nullptr;
  std::array<std::vector<float>, 3> position_, velocity_;  // in the world, m and m/s
};

}  // namespace softbody
