#pragma once
// The inner loops of penalty contact. Vectorised with Highway, which chooses the processor's instruction set at run
// time; the result is the same on every one. A part of the pairs means the blocks of them that begin there.

#include <span>

#include "collide/core/workers.h"
#include "softbody/forces/kernels/penalty_pairs.h"

namespace softbody {

/// What acts on all pairs of a substep.
struct PenaltyStep {
  float thickness;     // of the contact layer, m
  float damper_limit;  // 1/s, of a damper over the damped mass
  float seconds;       // of slip, and of what is summed
  // Sums of each pair; nullptr: neither is summed.
  float* impulse;   // N s along the normal
  float* returned;  // J, that restitution gives back of what the dampers take
};

/// The end of a pair that a force acts on.
struct PenaltyEnd {
  std::uint32_t pair : 31, at_b : 1;
  float sign() const { return 1.0f - 2.0f * float(at_b); }  // of the force on a
};

struct PenaltyKernels {
  /// Evaluates the forces (N) on the particles a, lets friction springs slip, and adds to the sums. motion: m and m/s
  /// of each particle.
  void (*evaluate)(collide::Part, PenaltyPairs&, const PenaltyParticle* motion, const PenaltyStep&, glm::vec4* force);
  /// Writes what each block of pairs stores, in J.
  void (*measure)(collide::Part, const PenaltyPairs&, const PenaltyParticle* motion, float thickness, double* stored);
  /// Sets the normals and the constants of the law. traits: of each particle, as of set_normals() and
  /// PenaltyContact::find().
  void (*prepare)(collide::Part, PenaltyPairs&, const PenaltyParticle* motion, const PenaltyParticle* traits);
  /// Writes the surface's unit normals at particles of a batch, whose slots are given and ascend. x: of the batch.
  void (*set_normals)(const Batch&, Field<const float> x, std::span<const std::uint32_t> slots,
                      PenaltyParticle* traits);
  /// Adds the forces of the ends of each particle, which begin at first_end. f: on particles from the slot `base` on.
  void (*add)(std::span<const std::uint32_t> slots, const std::uint32_t* first_end, const PenaltyEnd*,
              const glm::vec4* force, std::size_t base, Field<float> f);
};

const PenaltyKernels& penalty_kernels();

}  // namespace softbody
