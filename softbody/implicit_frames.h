#pragma once
// Frames that move with free bodies, one a lane, for implicit steps: steps of a turning body lead along chords, by
// which it swells and its velocities lag behind; in a frame that turns with it there is none of that.

#include "softbody/implicit_solver.h"
#include "softbody/rigid_motion.h"

namespace softbody {

/// During a step a frame's origin falls with the body's centre of mass, and it turns as fast as the body at the start.
/// What is in it feels the centrifugal and the Coriolis acceleration, and of gravity nothing.
class ImplicitFrames {
 public:
  /// At the start of a step, for the lanes `which`; in the others the frame is the world's. x, v: m and m/s, there.
  ImplicitFrames(const Lanes& x, const Lanes& v, const std::array<bool, lanes>& which, const glm::dvec3& gravity);

  /// Takes positions and velocities of the start into the frames.
  void enter(Lanes& x, Lanes& v) const;
  /// Takes them back from there at the end of a step of h.
  void leave(double h, Lanes& x, Lanes& v) const;
  /// m/s^2, what each particle feels there.
  void accelerations(const Lanes& x, const Lanes& v, Lanes& a) const;

 private:
  template <class Change>
  void for_each(Lanes& x, Lanes& v, const Change& change) const;

  std::array<bool, lanes> which_;
  std::array<RigidMotion, lanes> start_;
  glm::dvec3 gravity_;
};

}  // namespace softbody
