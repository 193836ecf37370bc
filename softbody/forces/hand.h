#pragma once
// The hand that pulls a body.

#include <optional>
#include <string_view>

#include "softbody/forces/force.h"
#include "softbody/forces/grab.h"

namespace softbody {

/// Pulls one body, or none. It acts last in a step, for its force depends on what all else does there: see pull().
class Hand {
 public:
  static constexpr std::string_view key = "grab";
  static constexpr bool internal = false;
  static const char* why_not(const ForceFacts& facts) { return facts.held ? nullptr : "nobody holds a body"; }
  /// Adds its force to those on the body of the batch that it holds, which must be complete but for gravity.
  void add(const ForceBatch& batch);
  /// Adds its impulse in the step to the velocities of that body, which must hold what all else does in it.
  void kick(const ForceBatch& batch);

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

 private:
  glm::dvec3 point(State& state) const;
  glm::dvec3 force(const ForceBatch& batch, const glm::dvec3& velocity) const;

  std::optional<Grab> grab_;
  glm::dvec3 noted_point_{0.0};  // m
  glm::dvec3 exerted_{0.0};      // N, last since then: add() and kick() note it on the held body's thread
};

}  // namespace softbody
