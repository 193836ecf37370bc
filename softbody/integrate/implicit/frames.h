#pragma once
// Frames that move with the bodies, one a lane, for implicit steps: steps of a turning body lead along chords, by which
// it swells, its velocities lag behind and its spin is lost; in a frame that turns with it there is none of that.

#include "softbody/integrate/implicit/solver.h"
#include "softbody/state/rigid_motion.h"

namespace softbody {

/// During a step a frame's origin falls with the body's centre of mass, and it turns about as fast as the body at the
/// start. What is in it feels the centrifugal and the Coriolis acceleration, and of gravity nothing.
class ImplicitFrames {
 public:
  /// Of a step of h from x, v (m and m/s, in the world), for the lanes `which`; in the others the frame is the world's.
  /// The origins fall by h^2 gravity, as in a step of first order.
  ImplicitFrames(const Lanes& x, const Lanes& v, const std::array<bool, lanes>& which, double h,
                 const glm::dvec3& gravity);
  /// Those of some of its lanes.
  ImplicitFrames subset(const std::array<bool, lanes>& which) const;
  /// The same with origins that fall by so many m.
  ImplicitFrames falling(const glm::dvec3& fall) const;
  /// 1 for lanes that have a frame of their own, else 0.
  std::array<float, lanes> moves() const;
  /// How the body in a lane that has a frame moves in the world at the start.
  const RigidMotion& start(std::size_t lane) const { return frames_[lane].body; }

  /// Takes positions and velocities of the start into the frames. frame_displacement: m, how far the frame takes a
  /// particle along.
  void enter(Lanes& x, Lanes& v, Lanes& frame_displacement) const;
  /// Turns what is told in the world's directions, and back.
  glm::dvec3 enter(std::size_t lane, const glm::dvec3& v) const { return glm::transpose(frames_[lane].turned) * v; }
  glm::dvec3 leave(std::size_t lane, const glm::dvec3& v) const { return frames_[lane].turned * v; }
  LinearPenaltyPair enter(const LinearPenaltyPair& pair) const;
  /// m/s^2, what each particle feels there.
  void accelerations(const Lanes& x, const Lanes& v, Lanes& a) const;
  /// Takes positions and velocities of the end back into the world.
  void leave(Lanes& x, Lanes& v) const;

  // Of a particle at x, v of the start, in the world: velocity without that of the frame's turning; how far it goes in
  // the step if nothing acts on it, and what of that is the turning's.
  glm::dvec3 velocity_without_spin(std::size_t lane, const glm::dvec3& x, const glm::dvec3& v) const;
  glm::dvec3 turn(std::size_t lane, const glm::dvec3& x) const;
  glm::dvec3 free_displacement(std::size_t lane, const glm::dvec3& x, const glm::dvec3& v) const;

 private:
  struct Frame {
    bool active = false;
    RigidMotion body;        // at the start
    glm::dvec3 spin{0.0};    // rad/s, of the frame
    glm::dmat3 turned{1.0};  // by the end
  };
  template <class Change>
  void for_each(Lanes& x, Lanes& v, const Change& change) const;

  std::array<Frame, lanes> frames_;
  double h_;
  glm::dvec3 gravity_, fall_;
};

}  // namespace softbody
