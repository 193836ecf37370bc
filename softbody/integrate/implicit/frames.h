#pragma once
// Frames that move with the bodies, one for each lane, for implicit steps. In the world's frame, the particles of a
// rotating body move along chords, so that the body swells, its velocities lag behind and its spin is lost. In a frame
// that rotates with the body they do not.

#include <array>

#include "softbody/integrate/implicit/problem.h"
#include "softbody/state/rigid_motion.h"

namespace softbody {

/// During a step, the origin of a frame falls with the body's centre of mass, and the frame rotates about as fast as
/// the body does at the start. In the frame act the centrifugal and the Coriolis acceleration, and no gravity.
class ImplicitFrames {
 public:
  /// Makes frames for a step of h from x, v (m and m/s, in the world), for the lanes `which`; the frame of other lanes
  /// is the world's. The origins fall by h^2 gravity, as in a step of first order.
  ImplicitFrames(const Lanes& x, const Lanes& v, LaneMask which, double h, const glm::dvec3& gravity);
  /// Returns frames for the lanes `which` only; the frame of other lanes is the world's.
  ImplicitFrames subset(LaneMask which) const;
  /// Lets the origins fall by `fall` (m).
  void set_fall(const glm::dvec3& fall) { fall_ = fall; }
  double step() const { return h_; }  // s
  /// Returns the lanes that have a frame of their own.
  LaneMask active() const { return active_; }
  /// Returns the rigid motion, in the world, that the body of a lane with a frame has at the start.
  const RigidMotion& start(std::size_t lane) const { return frames_[lane].body; }

  /// Transforms positions and velocities of the start into the frames, for the lanes that have one of their own.
  void enter(const Lanes& x, const Lanes& v, ImplicitStart& start) const;
  // Rotate directions and contacts from the world into a frame, and directions back.
  glm::dvec3 enter(std::size_t lane, const glm::dvec3& v) const { return glm::transpose(frames_[lane].turned) * v; }
  glm::dvec3 leave(std::size_t lane, const glm::dvec3& v) const { return frames_[lane].turned * v; }
  PlaneContact enter(const PlaneContact& contact) const;
  LinearPenaltyPair enter(const LinearPenaltyPair& pair) const;
  /// Sets `a` to the acceleration (m/s^2) that the frame adds to each particle.
  void accelerations(const Lanes& x, const Lanes& v, Lanes& a) const;
  /// Transforms positions and velocities of the end back into the world.
  void leave(Lanes& x, Lanes& v) const;

  /// Returns the displacement (m) in the step of a particle with x, v at the start, in the world, if no force acts on
  /// it.
  glm::dvec3 free_displacement(std::size_t lane, const glm::dvec3& x, const glm::dvec3& v) const;

 private:
  struct Frame {
    RigidMotion body;        // at the start
    glm::dvec3 spin{0.0};    // rad/s, of the frame
    glm::dmat3 turned{1.0};  // by the end
  };
  template <class Change>
  void for_each(Lanes& x, Lanes& v, const Change& change) const;

  LaneMask active_;
  std::array<Frame, implicit_lanes> frames_;
  double h_;
  glm::dvec3 gravity_, fall_;
};

}  // namespace softbody
