#pragma once
// A second world beside the one that is shown: the same bodies from the same state on, moved by another integrator.

#include <memory>

#include "app/base/time_series.h"
#include "app/compare/positions.h"
#include "softbody/integrate/integrators.h"
#include "softbody/world/world.h"

namespace app::session {

/// There is one if the user wants it. It is kept in step with the world that is shown (`of`). What functions
/// throw is for the user. The ghost ends if restart() or step() throws.
class Ghost {
 public:
  /// Begins a ghost of the present state, or ends it. If it throws, the ghost before stays.
  void choose(const softbody::World& of, const std::optional<softbody::IntegratorChoice>& choice, int threads);
  /// The world was changed: the ghost begins anew from its present state, or ends if there is none (nullptr).
  void restart(const softbody::World* of);
  /// Follows a step of the world.
  void step(const softbody::World& of);

  /// Returns nullptr if there is no ghost.
  const softbody::World* world() const { return world_.get(); }
  /// Returns the positions before its last step.
  const compare::Positions& before_last_step() const { return before_; }
  /// Returns the root mean square distance of all vertices to those of `of`, which has the same bodies; each distance
  /// over the radius of its body. Precondition: there is a ghost.
  double distance(const softbody::World& of) const;
  /// True if some vertex is not finite or very far away. Then the ghost is neither stepped nor drawn.
  bool blown_up() const { return blown_up_; }
  bool at_rest() const { return !world_ || blown_up_ || world_->all_at_rest(); }
  /// How long (ms) its last step took.
  double step_ms() const { return world_ ? world_->last_step().total_ms : 0; }
  /// The distance of the ghost from the world, by frame.
  const TimeSeries& distances() const { return distances_; }
  /// Changes whenever the ghost may be elsewhere or another.
  std::uint64_t revision() const { return revision_; }

 private:
  void restarted();
  void end();

  std::unique_ptr<softbody::World> world_;
  compare::Positions before_;
  bool blown_up_ = false;
  TimeSeries distances_;
  std::uint64_t revision_ = 0;
};

}  // namespace app::session
