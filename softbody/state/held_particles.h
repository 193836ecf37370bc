#pragma once
// Particles that are held: each has the velocity that its hold gives it, whatever acts on it. To all else it has an
// infinite mass. Who changes velocities calls impose() after it.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "softbody/state/body.h"
#include "softbody/state/lanes.h"

namespace softbody {

struct Batch;
class State;

struct HeldParticle {
  std::uint32_t slot;        // in the state's arrays
  BodyId body;               // whose ...
  std::uint32_t hold;        // ... hold this is
  glm::vec3 velocity{0.0f};  // m/s, in the substep at hand
};

class HeldParticles {
 public:
  /// Lists the held particles of all bodies that move, and gives them their velocities.
  void begin_frame(State& state);
  /// Finds the velocities with which the particles of a batch come to their places in a substep of h (s), and imposes
  /// them. Other threads may do so for other batches.
  void begin_substep(State& state, const Batch& batch, float h);
  /// Gives the particles of a batch their velocities. v: of all batches.
  void impose(const Batch& batch, Field<float> v) const;
  /// Ends a substep of a batch, in which f (N, of the batch) and gravity (m/s^2) act: sums the work of its holds, and
  /// moves their axes on.
  void end_substep(State& state, const Batch& batch, Field<const float> f, const glm::dvec3& gravity, float h);
  /// Returns the work (J) since the last call.
  double take_work();

  std::span<const HeldParticle> of(const Batch& batch) const;
  bool any(const Batch& batch) const { return !of(batch).empty(); }
  /// Returns true if the holds of a batch, or any at all, move.
  bool moves(const Batch& batch) const;
  bool moves() const { return moves_; }
  /// Returns 0 for a particle of the batch that is held, else 1, in the order of its arrays; nullptr if none is held.
  const float* free(const Batch& batch) const;
  /// Returns whether each vertex of a body is held; empty if none is.
  std::span<const char> of(BodyId body) const;

 private:
  struct OfBatch {
    std::vector<HeldParticle> particles;
    std::vector<float> free;
    bool moves = false;
    double work = 0;  // J
  };

  std::vector<OfBatch> of_batch_;           // empty if nothing is held
  std::vector<std::vector<char>> of_body_;  // likewise
  bool moves_ = false;
};

}  // namespace softbody
