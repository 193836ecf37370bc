#pragma once
// A second world beside the one that is shown: the same bodies from the same state on, moved by another integrator.

#include "app/compare/drawn_positions.h"
#include "softbody/integrators.h"
#include "softbody/world.h"

namespace app::session {

class Ghost {
 public:
  /// From the present state of `of` on. Throws SceneError if the integrator cannot move it.
  Ghost(const softbody::World& of, const softbody::IntegratorChoice& choice, int threads);

  /// Into the present state of `of` again, which has been changed by hand. Throws as the constructor.
  void restart(const softbody::World& of);
  /// One frame, unless it has blown up.
  void step();

  const softbody::IntegratorChoice& choice() const { return choice_; }
  const softbody::World& world() const { return world_; }
  /// `part` of the way from the last frame but one.
  compare::DrawnPositions drawn_positions(float part) const {
    return {world_.positions(), before_.x, before_.y, before_.z, part};
  }
  /// The root mean square over all vertices of their distance to those of `of`, each over its body's radius. Of worlds
  /// with the same bodies.
  double distance(const softbody::World& of) const;
  /// Some vertex is no longer finite, or thousands of radii away: it is neither moved nor worth a look.
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
