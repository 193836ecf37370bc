#pragma once
// What forces are told.

#include <span>

#include "softbody/state/state.h"

namespace softbody {

/// What a scene has, for the plan.
struct ForceFacts {
  std::span<const std::shared_ptr<const BodyModel>> models;
  const char* why_no_vertex_contact;  // nullptr: vertices keep the bodies apart
  bool held;                          // a hand holds a body
};

/// The bodies of a batch, in a step of h seconds.
struct ForceBatch {
  State& state;
  const Batch& batch;
  double h;            // s
  glm::dvec3 gravity;  // m/s^2
  Field<float> f;      // N, on the batch's particles

  KickArguments kick_arguments() const {
    const glm::vec3 g = float(h) * glm::vec3(gravity);
    return {batch.particles(), float(h), float(h) / float(batch.model->particle_mass), g.x, g.y, g.z,
            batch.moves.data()};
  }
};

}  // namespace softbody
