#pragma once
// How much of a detector's work the thread of the window takes upon itself.

#include "app/compare/compare.h"
#include "app/compare/cost_model.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::session {

inline constexpr std::uint64_t max_window_work = work_of_part(1'000'000'000);  // of a frame: about half a second

/// Returns the work of a method that knows nothing from earlier frames, on the current positions.
inline compare::WorkEstimate window_work(const softbody::BodiesInMotion& world, const collide::Method& method,
                                         const collide::Settings& settings) {
  compare::CostModel cost_model;
  cost_model.begin(world.positions(), settings, 0);
  return cost_model.of(compare::method_index(method.key));
}

/// Throws SceneError if the method would hold the window up: it runs where the bodies are moved and drawn.
inline void require_affordable(const softbody::BodiesInMotion& world, const collide::Method& method,
                               const collide::Settings& settings) {
  const compare::WorkEstimate work = window_work(world, method, settings);
  if (work.cost() > max_window_work)
    throw softbody::SceneError(method.name + " would take " + work.in_words() +
                               " a frame here: too long to drive the bodies with");
}

}  // namespace app::session
