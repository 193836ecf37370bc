#pragma once
// A second world beside the one that is shown: the same bodies from the same state on, moved by another integrator.

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
  /// Takes one step, unless the ghost has blown up.
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
  bool has_blown_up() const;

  softbody::IntegratorChoice choice_;
  softbody::World world_;
  compare::Positions before_;
  bool blown_up_ = false;
};

}  // namespace app::session
