#pragma once
// What the user does with bodies: select, drop, throw, add and delete them.

#include "app/session/simulation.h"

namespace app::session {

class BodyControls {
 public:
  static constexpr int many_drops = 20;                               // bodies, of one key press
  static constexpr double min_throw_speed = 1, max_throw_speed = 25;  // m/s

  double throw_speed = 12;  // m/s

  explicit BodyControls(Simulation& simulation) : simulation_(simulation) {}

  bool can_drop() const;
  void drop(int count = 1);
  /// Throws a body from `eye` so that it flies to `target` (m, another point), against gravity: at throw_speed, or
  /// faster if it would not get there, up to max_throw_speed.
  void throw_body(const glm::dvec3& eye, const glm::dvec3& target);
  /// Adds a body. It gets the scene's material that equals `material` but for its name; if there is none, the scene
  /// gets this one.
  void add(softbody::BodySource body, softbody::Material material);

  const std::optional<softbody::BodyId>& selected() const { return selected_; }
  void select(std::optional<softbody::BodyId> body);
  void remove_selected();
  /// Holds a particle of the selected body where it is, or lets go of it.
  void switch_hold(softbody::Index particle);

 private:
  Simulation& simulation_;
  std::optional<softbody::BodyId> selected_;
};

}  // namespace app::session
