#pragma once
// Axes that move with the bodies, those of each lane, for implicit steps. In the world's axes, the particles of a
// rotating body move along chords, so that the body swells, its velocities lag behind and its spin is lost. In axes
// that rotate with the body they do not.

#include <array>

#include "softbody/integrate/implicit/problem.h"
#include "softbody/state/rigid_motion.h"

namespace softbody {

/// During a step, the origin of the axes falls with the body's centre of mass, and the axes rotate about as fast as the
/// body does at the start. In them act the centrifugal and the Coriolis acceleration, and no gravity.
class MovingAxes {
 public:
  /// Makes axes for a step of h from x, v (m and m/s, in the world), for the lanes `which`; those of other lanes are
  /// the world's. The origins fall by h^2 gravity, as in a step of first order.
  MovingAxes(const Lanes& x, const Lanes& v, LaneMask which, double h, const glm::dvec3& gravity);
  /// Returns axes for the lanes `which` only; those of other lanes are the world's.
  MovingAxes subset(LaneMask which) const;
  /// Lets the origins fall by `fall` (m).
  void set_fall(const glm::dvec3& fall) { fall_ = fall; }
  double step() const { return h_; }  // s
  /// Returns the lanes that have axes of their own.
  LaneMask active() const { return active_; }
  /// Returns the rigid motion, in the world, that the body of such a lane has at the start.
  const RigidMotion& start(std::size_t lane) const { return axes_[lane].body; }

  /// Transforms positions and velocities of the start into the axes, for the lanes that have their own.
  void enter(const Lanes& x, const Lanes& v, ImplicitStart& start, std::span<const HeldEnd> held = {}) const;
  // Rotate directions and contacts from the world into the axes, and directions back.
  glm::dvec3 enter(std::size_t lane, const glm::dvec3& v) const { return glm::transpose(axes_[lane].turned) * v; }
  glm::dvec3 leave(std::size_t lane, const glm::dvec3& v) const { return axes_[lane].turned * v; }
  PlaneContact enter(const PlaneContact& contact) const;
  LinearPenaltyPair enter(const LinearPenaltyPair& pair) const;
  /// Sets `a` to the acceleration (m/s^2) that the axes add to each particle.
  void accelerations(const Lanes& x, const Lanes& v, Lanes& a) const;
  /// Transforms positions and velocities of the end back into the world.
  void leave(Lanes& x, Lanes& v) const;

  /// Returns the displacement (m) in the step of a particle with x, v at the start, in the world, if no force acts on
  /// it.
  glm::dvec3 free_displacement(std::size_t lane, const glm::dvec3& x, const glm::dvec3& v) const;

 private:
  struct Axes {
    RigidMotion body;        // at the start
    glm::dvec3 spin{0.0};    // rad/s, of the axes
    glm::dmat3 turned{1.0};  // by the end
  };
  template <class Change>
  void for_each(Lanes& x, Lanes& v, const Change& change) const;

  LaneMask active_;
  std::array<Axes, implicit_lanes> axes_;
  double h_;
  glm::dvec3 gravity_, fall_;
};

}  // namespace softbody
