#pragma once
// Frames that move with the bodies, one a lane, for implicit steps: steps of a turning body lead along chords, by which
// it swells, its velocities lag behind and its spin is lost; in a frame that turns with it there is none of that.

#include "softbody/implicit_solver.h"
#include "softbody/rigid_motion.h"

namespace softbody {

/// During a step a frame's origin falls with the body's centre of mass, and it turns as fast as the body at the start.
/// What is in it feels the centrifugal and the Coriolis acceleration, and of gravity nothing.
class ImplicitFrames {
 public:
  /// Of a step of h from x, v (m and m/s, in the world), for the lanes `which`; in the others the frame is the world's.
  /// fall: m, of the origins.
  ImplicitFrames(const Lanes& x, const Lanes& v, const std::array<bool, lanes>& which, double h,
                 const glm::dvec3& gravity, const glm::dvec3& fall);

  /// Takes positions and velocities of the start into the frames. carried: m, how far the frame takes a particle along.
  void enter(Lanes& x, Lanes& v, Lanes& carried) const;
  void enter(std::span<PlaneContact> planes) const;
  void enter(std::span<LinearShield> shields) const;
  /// m/s^2, what each particle feels there.
  void accelerations(const Lanes& x, const Lanes& v, Lanes& a) const;
  /// Takes positions and velocities of the end back into the world.
  void leave(Lanes& x, Lanes& v) const;
  glm::dvec3 leave(std::size_t lane, const glm::dvec3& force) const { return frames_[lane].turned * force; }

 private:
  struct Frame {
    bool own = false;
    RigidMotion start;
    glm::dmat3 turned{1.0};  // by the end
  };
  template <class Change>
  void for_each(Lanes& x, Lanes& v, const Change& change) const;

  std::array<Frame, lanes> frames_;
  double h_;
  glm::dvec3 gravity_, fall_;
};

}  // namespace softbody
