#pragma once
// Where the particles of all bodies are, how fast they go, and which body is in which lane. It knows no force, no
// contact and no integrator.

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>

#include "softbody/model/body_model.h"
#include "softbody/state/body.h"
#include "softbody/state/energy_ledger.h"
#include "softbody/state/held_particles.h"
#include "softbody/state/kernel_types.h"
#include "softbody/state/lanes.h"

namespace softbody {

/// Up to `width` bodies of one model, one in each lane. Their values start at `base` in every array of the state.
struct Batch {
  std::shared_ptr<const BodyModel> model;
  Index index = 0;    // of this batch
  int width = lanes;  // one of the widths of lanes.h
  std::size_t base = 0;
  int used = 0;  // lanes taken
  std::array<BodyId, lanes> body{};
  std::array<float, lanes> moves{};  // 1: integrated; 0: asleep, pinned or an empty lane

  std::size_t particles() const { return model->mesh.vertices.size(); }
  std::size_t values() const { return particles() * std::size_t(width); }  // of one array
  bool any_moves() const {
    return std::ranges::any_of(moves, [](float m) { return m > 0; });
  }
};

/// A batch with its positions and velocities (m and m/s).
struct BatchView {
  const Batch& batch;
  Field<float> x, v;
};

/// What is remembered of an impact until the two sides part, see contact/rebound.h.
struct Impact {
  glm::dvec3 energy{0.0};  // J along the contact's normals, that restitution has to give back
  float speed = 0;         // m/s, the largest with which they came together; 0: it is over, or was slow
  float parting = 0;       // m/s, of the last frame in which contact pushed
  float calm = 0;          // s, for how long contact has hardly made the two sides part faster
  float given = 0;         // J, that it gave back in the last frame
};

/// Vertices of a body that are moved, whatever acts on them.
struct HeldVertices {
  std::vector<Index> vertices;
  glm::dvec3 velocity{0.0};  // m/s ...
  glm::dvec3 spin{0.0};      // ... and rad/s, about an axis through a place that moves at this velocity, too:
  glm::dvec3 through{0.0};   // m
  int from = 0, until = 0;   // the frames in which they are taken and let go; 0: never
  bool on = false;           // in the frame at hand
  bool moves() const { return velocity != glm::dvec3(0.0) || spin != glm::dvec3(0.0); }
};

/// What World, sleep and Resistance remember of a body from one frame to the next.
struct BodyMemory {
  int source = -1;                    // the index among the scene's bodies; -1: it is not from the scene
  int release = 0;                    // the frame until which it is pinned
  int calm_frames = 0;                // for how many frames it has been slow enough to sleep
  bool may_lie_in_solid = true;       // it has been placed there, or solids have been moved, and not come out since
  Impact impact;                      // on the solids that it touches
  double speed = 0;                   // m/s, of its fastest particle, as of the end of the last frame in which it moved
  std::vector<HeldVertices> holds{};  // of a vertex in two of them, the first one decides
};

struct Body : BodyState {
  Index batch;
  int lane;
  BodyMemory memory{};
};

/// The components of one vector for each particle of all bodies.
using VectorArray = std::array<LaneArray<float>, 3>;

inline Field<float> field(VectorArray& a, std::size_t base = 0) {
  return {a[0].data() + base, a[1].data() + base, a[2].data() + base};
}
inline Field<const float> field(const VectorArray& a, std::size_t base = 0) {
  return {a[0].data() + base, a[1].data() + base, a[2].data() + base};
}

class State {
 public:
  VectorArray x, v, f;  // m relative to the bodies' origins, m/s, N
  EnergyLedger ledger;
  HeldParticles held;  // in the frame at hand

  /// Adds a body at `position` (m), turned about there by `axes`. It moves at `velocity` (m/s), and turns about its
  /// middle by `spin` (rad/s).
  BodyId add(const std::shared_ptr<const BodyModel>& model, const glm::dvec3& position, const glm::dvec3& velocity,
             const glm::dmat3& axes = glm::dmat3(1.0), const glm::dvec3& spin = glm::dvec3(0.0));
  /// Removes a body; the ids of later bodies move up by one.
  void remove(BodyId body);
  /// Gives the bodies of the model `from` the model `to`, of the same mesh. They stay where they are.
  void replace(const std::shared_ptr<const BodyModel>& from, const std::shared_ptr<const BodyModel>& to);
  void set_pinned(BodyId body, bool pinned);
  /// A body that falls asleep loses its velocities.
  void set_asleep(BodyId body, bool asleep);
  /// Sets all particles of a body, one for each vertex, finite. The body's origin goes to their middle.
  void set_particles(BodyId body, std::span<const Particle> particles);
  /// Moves the origins of a batch's bodies that move after their particles, where these have gone far.
  void recentre(const Batch& batch);
  BodyMemory& memory(BodyId body) { return bodies_[body].memory; }

  std::span<const Batch> batches() const { return batches_; }
  const Batch& batch_of(BodyId body) const { return batches_[bodies_[body].batch]; }
  BodyId body_count() const { return static_cast<BodyId>(bodies_.size()); }
  const Body& body(BodyId id) const { return bodies_[id]; }
  const BodyModel& model(BodyId body) const { return *batch_of(body).model; }
  /// Returns where the values of a vertex of a body stand in the arrays.
  std::size_t slot(BodyId body, Index vertex) const {
    const Batch& b = batch_of(body);
    assert(vertex < b.particles());
    return b.base + std::size_t(vertex) * std::size_t(b.width) + std::size_t(bodies_[body].lane);
  }
  /// Returns the vectors of one body in an array over all particles.
  BodyField field_of(BodyId body, VectorArray& array) const {
    return {field(array), slot(body, 0), std::size_t(batch_of(body).width)};
  }
  /// Returns the bounds of `boxed`, and the length of the longest vector of `measured`, for each body of a batch.
  Extent extent(const Batch& batch, const VectorArray& boxed, const VectorArray& measured) const;
  std::size_t particle_count() const;  // of all bodies, whether they move or not
  Particle particle(BodyId body, Index vertex) const;
  /// Returns the largest speed of a particle, in m/s, for the body in each lane; infinity if one is not finite.
  std::array<double, lanes> max_particle_speeds(const Batch& batch) const;
  double max_particle_speed(BodyId body) const {
    return max_particle_speeds(batch_of(body))[std::size_t(bodies_[body].lane)];
  }
  /// Write the positions of a batch's bodies in the world, and their velocities, one body after another: those of each
  /// from first[id] on.
  void write_positions(const Batch& batch, std::span<const Index> first, Field<float> to) const;
  void write_velocities(const Batch& batch, std::span<const Index> first, Field<float> to) const;
  /// Returns FNV-1a over the bits of origins, positions and velocities in the order of the ids.
  std::uint64_t hash() const;

  /// Returns a copy without the forces, which no frame takes over from the one before.
  State saved() const;
  /// Takes over a state that saved() has returned.
  void restore(const State& saved);
  std::size_t bytes() const;

 private:
  Batch& batch_with_free_lane(const std::shared_ptr<const BodyModel>& model);
  std::size_t append(std::size_t values);
  void widen(Batch& batch);
  void move_lane(Batch& batch, int from, int to);
  void update_moves(const Body& body);

  std::vector<Batch> batches_;
  std::vector<Body> bodies_;
};

/// The most particles of a body in implicit steps: the matrix grows faster than the springs.
inline constexpr std::size_t max_implicit_particles = 1000;

inline std::size_t bytes_of(const auto& list) { return list.size() * sizeof(list[0]); }

}  // namespace softbody
