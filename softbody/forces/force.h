#pragma once
// What forces are told.

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "softbody/model/body_model.h"
#include "softbody/state/lanes.h"

namespace softbody {

/// What a scene has, for the plan.
struct ForceFacts {
  std::span<const std::shared_ptr<const BodyModel>> models;
  const char* why_no_vertex_contact;  // nullptr: vertices keep the bodies apart
  bool held;                          // a hand holds a body
};

/// The particle (relative to the body's own origin) that a hand pulls at, of a body in the lanes at hand.
struct HeldPoint {
  std::array<std::size_t, 3> corners;  // indices into the fields
  glm::dvec3 position;                 // m
};

/// The bodies of one model that are side by side in lanes, and what acts on them in a step of h seconds. The fields are
/// those of all bodies together; the values of these begin at `base`.
struct ForceBatch {
  const BodyModel& model;
  std::size_t index, base;  // of the batch
  int width, used;          // lanes, and how many of them have a body
  const float* moves;       // 0 or 1 for each lane
  Field<const float> x;     // m
  Field<float> v, f;        // m/s and N
  float h;                  // s
  glm::dvec3 gravity;       // m/s^2
  const HeldPoint* held;    // nullptr: nobody holds one of these bodies
};

}  // namespace softbody
