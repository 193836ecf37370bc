#pragma once
// A second world beside the one that is shown: the same bodies from the same state on, moved by another integrator.

#include <memory>
#include <string>

#include "app/base/time_series.h"
#include "app/compare/drawn_positions.h"
#include "softbody/integrate/integrators.h"
#include "softbody/world/world.h"

namespace app::session {

class Ghost {
 public:
  /// Starts from the present state of `of`. Throws SceneError if the integrator cannot move it.
  Ghost(const softbody::World& of, const softbody::IntegratorChoice& choice, int threads);

  /// Starts again from the present state of `of`, which the user changed. Throws as the constructor.
  void restart(const softbody::World& of);
  /// Takes one step. Precondition: not blown_up().
  void step();

  const softbody::IntegratorChoice& choice() const { return choice_; }
  const softbody::World& world() const { return world_; }
  /// Returns positions `part` of the way from the frame before to the present one.
  compare::DrawnPositions drawn_positions(float part) const { return {world_.positions(), before_, part}; }
  /// Returns the root mean square distance of all vertices to those of `of`, which has the same bodies; each distance
  /// over the radius of its body.
  double distance(const softbody::World& of) const;
  /// True if some vertex is not finite or very far away. Then the ghost is neither stepped nor drawn.
  bool blown_up() const { return blown_up_; }
  bool at_rest() const { return blown_up_ || world_.all_at_rest(); }

 private:
  softbody::IntegratorChoice choice_;
  softbody::World world_;
  compare::Positions before_;
  bool blown_up_ = false;
};

/// The ghost of the world that is shown, if the user wants one, kept in step with it. Functions return what went wrong,
/// for the user; the ghost is gone then. Empty: nothing did.
class LiveGhost {
 public:
  /// Begins a ghost of the present state, or ends it. On an error the ghost before stays.
  [[nodiscard]] std::string choose(const softbody::World& world,
                                   const std::optional<softbody::IntegratorChoice>& choice, int threads);
  /// The world was changed: the ghost begins anew from its present state, or ends if there is none (nullptr).
  [[nodiscard]] std::string restart(const softbody::World* world);
  /// Follows a step of the world.
  [[nodiscard]] std::string step(const softbody::World& world);

  /// nullptr if there is none.
  const Ghost* get() const { return ghost_.get(); }
  /// How long (ms) its last step took.
  double step_ms() const { return ghost_ ? ghost_->world().last_step().total_ms : 0; }
  /// The distance of the ghost from the world, by frame.
  const TimeSeries& distances() const { return distances_; }
  /// Changes whenever the ghost may be elsewhere or another.
  std::uint64_t revision() const { return revision_; }

 private:
  std::unique_ptr<Ghost> ghost_;
  TimeSeries distances_;
  std::uint64_t revision_ = 0;
};

}  // namespace app::session
