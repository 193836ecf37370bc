#pragma once
// The hand that pulls a body.

#include <optional>

#include "softbody/forces/grab.h"
#include "softbody/model/body_model.h"
#include "softbody/state/lanes.h"

namespace softbody {

/// A body in a hand.
struct HeldBody {
  const BodyModel& model;
  glm::dvec3 origin;  // m; positions are relative to it
  BodyField x, v, f;  // m, m/s and N
};

/// Pulls one body, or none. It acts last in a step, for its force depends on what all else does there: see pull().
class Hand {
 public:
  /// Takes a body in another's place; none: lets go.
  void take(const std::optional<Grab>& grab);
  const std::optional<Grab>& grab() const { return grab_; }
  /// Returns whether the hand pulls this body.
  bool holds(BodyId body) const { return grab_ && grab_->body == body; }
  /// Follows the ids when a body is taken out of the world, and those after it move up by one.
  void remove(BodyId body);

  /// Adds its force to the forces, which must be complete but for gravity (m/s^2), for a step of h seconds. `body`: the
  /// one that it holds.
  void add_force(const HeldBody& body, double h, const glm::dvec3& gravity) const;
  /// Adds its impulse in a step of h seconds to the velocities, which must hold what all else does in the step.
  void add_impulse(const HeldBody& body, double h) const;

 private:
  glm::dvec3 force(const HeldBody& body, double h, const glm::dvec3& velocity) const;

  std::optional<Grab> grab_;
};

}  // namespace softbody
