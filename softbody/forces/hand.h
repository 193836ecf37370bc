#pragma once
// The hand that pulls a body.

#include <optional>
#include <string_view>

#include "softbody/forces/force.h"
#include "softbody/forces/grab.h"

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
  static constexpr std::string_view key = "grab";
  static constexpr bool internal = false;
  static const char* why_not(const ForceFacts& facts) { return facts.held ? nullptr : "nobody holds a body"; }
  /// Adds its force to the body of the batch that it holds.
  void add(const ForceBatch& batch) const;
  /// Adds its impulse to it.
  void kick(const ForceBatch& batch) const;

  /// Notes where the point is that the hand holds. Call it before a substep ...
  void note_point(State& state);
  /// ... and after it: books the work that its force did.
  void book_work(State& state) const;

  /// Takes a body in another's place; none: lets go.
  void take(const std::optional<Grab>& grab);
  const std::optional<Grab>& grab() const { return grab_; }
  /// Returns whether the hand pulls this body.
  bool holds(BodyId body) const { return grab_ && grab_->body == body; }
  bool holds(const State& state, const Batch& batch) const {  // one of its bodies
    return grab_ && state.body(grab_->body).batch == batch.index;
  }
  /// Follows the ids when a body is taken out of the world, and those after it move up by one.
  void remove(BodyId body);

  /// Adds its force to the forces, which must be complete but for gravity (m/s^2), for a step of h seconds. `body`: the
  /// one that it holds.
  void add_force(const HeldBody& body, double h, const glm::dvec3& gravity) const;
  /// Adds its impulse in a step of h seconds to the velocities, which must hold what all else does in the step.
  void add_impulse(const HeldBody& body, double h) const;

 private:
  glm::dvec3 point(const HeldBody& body) const;
  glm::dvec3 force(const HeldBody& body, double h, const glm::dvec3& velocity) const;

  std::optional<Grab> grab_;
  glm::dvec3 noted_point_{0.0};      // m
  mutable glm::dvec3 exerted_{0.0};  // N, last since then: add() and kick() note it on the held body's thread
};

}  // namespace softbody
