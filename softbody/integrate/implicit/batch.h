#pragma once
// What implicit steps see of a batch of bodies.

#include <array>
#include <functional>
#include <memory>
#include <span>

#include "softbody/contact/solid_law.h"
#include "softbody/forces/penalty_contact.h"
#include "softbody/model/body_model.h"

namespace softbody {

/// The start of a step of a batch, and what may touch it.
struct ImplicitBatch {
  const std::shared_ptr<const BodyModel>& model;
  std::span<const float, lanes> moves;  // 0 or 1 for each lane
  Field<const float> x, v;              // m and m/s, of all batches
  std::size_t base;                     // where the values of this one start in them
  glm::dvec3 gravity;                   // m/s^2
  std::span<const SolidArguments> near_solids;
  const PenaltyContact& penalty;          // evaluated at x, v
  std::span<const PenaltyEnd> ends;       // of its pairs, those that fall to this batch
  std::function<bool(BodyId)> is_moving;  // false for bodies that are held or asleep
};

/// Where the end of a step goes. Lanes that do not move are left alone.
struct ImplicitResult {
  Field<float> mean, rest;  // m/s, of all batches: velocities that lead to the end, and what they change by there
  Field<float> impulse;     // N s, a value a lane: the normal impulses of solids are added here ...
  float* returned;          // ... and here their sizes times the restitution
};

}  // namespace softbody
