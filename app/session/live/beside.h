#pragma once
// A second world beside the one that is simulated: the same bodies and solids from the same state on, moved with other
// settings, in step.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/compare/blow_up_monitor.h"
#include "app/compare/difference.h"
#include "app/compare/positions.h"
#include "app/compare/run_figures.h"
#include "softbody/world/snapshot.h"
#include "softbody/world/world.h"

namespace app::session {

enum class Half { first, second };

/// Returns the point (m) of the body that the hand holds. The world must have this body.
glm::dvec3 held_point(const softbody::World& world, const softbody::Grab& grab);

/// What these functions throw is for the user. If step(), follow() or restart() throws, the worlds are no longer alike,
/// and the second one must go.
class Beside {
 public:
  /// What brings the second world back.
  struct Kept {
    softbody::Snapshot world;
    compare::Difference difference;
    std::string stopped;
  };

  /// Takes `second`, which may be any world, and lets it go on from the state of `first`.
  Beside(std::unique_ptr<softbody::World> second, const softbody::World& first, const compare::Difference& difference);

  /// Goes on from the state of the first world. All figures begin anew.
  void restart(const softbody::World& first);
  /// Sets how the second world differs from now on. One that has stopped then goes on from the state of the first.
  /// Changes nothing if these settings are refused.
  void differ(const softbody::World& first, const compare::Difference& difference);
  /// Does what the user has just done to bodies, solids and settings of the first world.
  void follow(const softbody::World& first);
  /// Follows a step of the first world.
  void step(const softbody::World& first);

  Kept keep() const { return {world_->snapshot(), difference_, stopped_}; }
  /// Goes to what was kept, beside the first world, which has gone to the same moment.
  void go_to(const Kept& kept, const softbody::World& first);
  /// Keeps the present, beside the newest of these snapshots of the first world, which is of the present, too. Forgets
  /// what was kept beside others.
  void keep(const std::vector<softbody::Snapshot>& past);
  /// Goes back beside the first world, which has gone to one of these snapshots; to the same state if nothing was kept
  /// there. Settings stay.
  void rewind(const softbody::World& first);

  const softbody::World& world() const { return *world_; }
  const compare::Difference& difference() const { return difference_; }
  /// Returns why the second world is no longer stepped: the sentence of its blow-up; else empty.
  const std::string& stopped() const { return stopped_; }
  /// Returns how far (m) the hand in the second world is from that in the first: it holds the same point of the body.
  glm::dvec3 hands_apart() const { return hands_apart_.value_or(glm::dvec3(0.0)); }
  bool at_rest() const { return !stopped_.empty() || world_->all_at_rest(); }
  const compare::WorldPositions& before_last_step() const { return before_last_step_; }
  /// What a half has cost and missed since the second world began.
  const compare::RunFigures& figures(Half half) const { return figures_[static_cast<std::size_t>(half)]; }
  /// Adds what the oracle saw in a half.
  void add(Half half, const collide::oracle::SurfaceFigures& seen) {
    figures_[static_cast<std::size_t>(half)].add(seen);
  }

 private:
  void apply(const softbody::World& first, const compare::Difference& difference);

  std::unique_ptr<softbody::World> world_;
  compare::Difference difference_;
  std::string stopped_;
  std::map<int, Kept> past_;               // by the first world's frame
  std::optional<glm::dvec3> hands_apart_;  // while the hand holds a body
  compare::WorldPositions before_last_step_;
  compare::BlowUpMonitor monitor_;
  std::array<compare::RunFigures, 2> figures_;  // by Half
};

}  // namespace app::session
