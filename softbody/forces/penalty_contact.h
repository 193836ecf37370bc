#pragma once
// The response to the detector's contacts: a penalty force between the vertices of each, by penalty_law.h. The friction
// spring of a pair holds from frame to frame as long as the pair does, so that bodies stick and not merely creep.
// Between closed bodies n comes from the surfaces' normals, so that a particle that has slipped through is still pushed
// out; elsewhere it is the line between the two. The stiffness is shared among the contacts of a particle: a wide
// contact layer is not stiffer.
//
// In a substep each thread gathers the particles of its batches, which stand side by side then; all threads evaluate
// the pairs; and each adds their forces to the particles of its batches, in the order of the pairs.

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "collide/core/detector.h"
#include "softbody/forces/force.h"
#include "softbody/forces/kernels/penalty.h"

namespace softbody {

class Rebounds;

/// Contacts that a detector has found.
struct DetectedContacts {
  const collide::Bodies& vertices;
  std::span<const BodyId> vertex_body;  // the body of each vertex
  const std::vector<collide::Contact>& contacts;
  float tolerance;  // m, with which they were found
};

/// The contact layer. It grows by 5 cm/s up to the tolerance, so that neither a larger tolerance nor bodies that other
/// contact let closer are thrown apart.
struct ContactLayer {
  float thickness = 0, begun = 0;  // m, now and when the frame began
  float tolerance = 0;             // m

  void grow(double seconds) { thickness = std::min(tolerance, begun + float(0.05 * seconds)); }
  bool grows() const { return thickness < tolerance; }
};

class PenaltyContact {
 public:
  static constexpr std::string_view key = "contact-response";
  static constexpr bool internal = false;
  static const char* why_not(const ForceFacts& facts) { return facts.why_no_vertex_contact; }
  static void adapt(Material& material, const Mesh& mesh);

  /// The largest share of a pair's relative velocity that a damper takes away in a substep, if the pair has the damped
  /// mass: that of its lighter particle, over the number of contacts there. All dampers on a particle together add no
  /// more than 2 gamma h = 4 max_damped to omega^2 h^2 + 2 gamma h <= 4, the condition of stable_step(). Of the 4, a
  /// step of 0.8 times the stable length leaves 4 (1 - 0.8^2). So contacts ask for no shorter steps by their damping.
  static constexpr float max_damped = 0.36f;
  float damper_limit = std::numeric_limits<float>::infinity();  // 1/s, of a damper over the damped mass
  bool sums_impacts = true;  // evaluate() does; false in implicit steps, which call add_impact()
  ContactLayer layer;
  PenaltyPairs pairs;          // their contacts ascend
  LaneArray<glm::vec4> force;  // on a, of the current substep, N

  /// tolerance: m. The contact layer is as thick from the start.
  explicit PenaltyContact(float tolerance = 0) : layer{tolerance, tolerance, tolerance} {}

  /// Takes the contacts for the coming frame of `seconds`, and hands the friction springs of those that were there
  /// before on to them. The contacts ascend. If the frame is cut short, layer.grow() must follow.
  void find(const DetectedContacts& detected, const State& state, double seconds, collide::Workers& workers);
  /// Forgets all pairs.
  void clear() { pairs.clear(), impulse_.clear(), returned_.clear(); }
  /// Finds the particles that the pairs join by their slots, which are below `slots`.
  void group(std::size_t slots, std::span<const Batch> batches);
  /// Forgets a body of `count` vertices from `first` on; bodies and vertices after it move up.
  void remove(BodyId body, Index first, Index count);

  /// Notes where the particles are that have pairs, and how fast: all of them, or those of a batch.
  void gather(Field<const float> x, Field<const float> v) { gather(collide::Part{0, slot_.size()}, x, v); }
  void gather(const Batch& batch, Field<const float> x, Field<const float> v) { gather(particles_of(batch), x, v); }
  /// Evaluates the forces of the pairs in `part` on the gathered particles, and stretches their friction springs by
  /// `seconds` of slip.
  void evaluate(collide::Part part, float seconds) {
    penalty_kernels().evaluate(part, pairs, motion_.data(),
                               {layer.thickness, damper_limit, seconds,
                                sums_impacts && bounces() ? impulse_.data() : nullptr, returned_.data()},
                               force.data());
  }
  /// Adds the forces that evaluate() has found.
  void add(const ForceBatch& batch) const;
  /// Measures what the pairs in `part` store, for energy().
  void measure(collide::Part part) {
    penalty_kernels().measure(part, pairs, motion_.data(), layer.thickness, stored_.data());
  }
  double energy() const;  // J, of all pairs, measured
  /// Returns true if a pair of the frame has restitution.
  bool bounces() const { return !impulse_.empty(); }
  /// Adds what one end of a pair has done to the motion of the two: an impulse (N s) along n, and the energy (J) that
  /// this has taken. Ends of one pair may be added at the same time.
  void add_impact(PenaltyEnd end, double impulse, double taken);
  /// Adds what the pairs with restitution have done in the frame.
  void take_impacts(Rebounds& rebounds);

  /// Returns the ends of pairs that fall to a batch.
  std::span<const PenaltyEnd> ends_of(const Batch& batch) const;
  /// Returns what the law stores, in J, when a has moved by `way` (m) along b from x.
  double energy(const PenaltyPair& pair, Field<const float> x, const glm::dvec3& way = glm::dvec3(0.0)) const;
  /// Returns an upper bound of the work (J) that a pair does on one particle while the other moves by `way` (m).
  double max_work(const PenaltyPair& pair, Field<const float> x, double way) const;
  /// Returns upper bounds of how fast the force on a falls with the motion of a in the coming `seconds`, in N/m.
  struct Slopes {
    float spring, damper;                // along n
    float across_spring, across_damper;  // while it sticks
  };
  Slopes slopes(const PenaltyPair& pair, Field<const float> x, Field<const float> v, float seconds) const;
  /// Hands the friction springs of the contacts `before` on to the same contacts of a part of the pairs; both ascend.
  void carry_over(collide::Part part, std::span<const collide::Contact> before, const VectorArray& stretch);

 private:
  struct Share;
  using Totals = std::pair<std::size_t, std::size_t>;
  /// Those of a batch, in the order of their slots.
  collide::Part particles_of(const Batch& batch) const {
    return pairs.empty() ? collide::Part{} : of_batch_[batch.index];
  }
  void gather(collide::Part particles, Field<const float> x, Field<const float> v);
  void take(const Share& share, const DetectedContacts& detected, const State& state);
  void group(const Share& share, std::size_t slots, std::span<const Batch> batches);
  void set_traits(const State& state, const Batch& batch);

  // Of each particle that has pairs.
  std::vector<std::uint32_t> slot_;             // in the state's arrays; ascend
  std::vector<std::uint32_t> first_end_;        // and one more
  LaneArray<PenaltyParticle> motion_, traits_;  // see penalty_kernels()
  std::vector<PenaltyEnd> ends_;                // of the pairs of each particle, in their order
  std::vector<collide::Part> of_batch_;         // the particles of each batch
  std::vector<double> stored_;                  // J, of each block of pairs
  // Of the pairs in a frame with restitution, see PenaltyStep. Implicit steps add b's ends to the second half.
  LaneArray<float> impulse_, returned_;
  std::vector<float> restitution_;  // of each body
};

}  // namespace softbody
