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
#include <cassert>
#include <limits>
#include <span>
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

  /// What holds for all pairs in a substep.
  struct Substep {
    float seconds;                                                // of slip, and of what is summed
    float damper_limit = std::numeric_limits<float>::infinity();  // 1/s, of a damper over the damped mass
    bool sums_impacts = true;                                     // false in implicit steps, which call add_impact()
  };
  /// What is remembered from one frame to the next.
  struct Memory {
    ContactLayer layer;
    PenaltyPairs pairs;  // their contacts ascend
  };

  /// tolerance: m. The contact layer is as thick from the start.
  explicit PenaltyContact(float tolerance = 0) : memory_{{tolerance, tolerance, tolerance}, {}} {}

  const ContactLayer& layer() const { return memory_.layer; }
  const PenaltyPairs& pairs() const { return memory_.pairs; }
  const Memory& memory() const { return memory_; }
  /// Goes on from there with the next find().
  void restore(const Memory& saved) { memory_ = saved; }
  /// Lets the contact layer grow anew, from nothing.
  void reset_layer() { memory_.layer = {}; }
  /// Ends a frame that took so long, which may be less than find() was told.
  void end_frame(double seconds) { memory_.layer.grow(seconds); }

  /// Takes the contacts for the coming frame of `seconds`, and hands the friction springs of those that were there
  /// before on to them. The contacts ascend.
  void find(const DetectedContacts& detected, const State& state, double seconds, collide::Workers& workers);
  /// Forgets all pairs.
  void clear() {
    memory_.pairs.clear();
    for (auto* sums : {&impulse_, &returned_}) sums->clear();
  }
  /// Forgets a body of `count` vertices from `first` on; bodies and vertices after it move up.
  void remove(BodyId body, Index first, Index count);

  /// Notes where the particles are that have pairs, and how fast: all of them, or those of a batch.
  void gather(Field<const float> x, Field<const float> v) { gather(collide::Part{0, slot_.size()}, x, v); }
  void gather(const Batch& batch, Field<const float> x, Field<const float> v) { gather(particles_of(batch), x, v); }
  /// Evaluates the forces of the pairs in `part` on the gathered particles, and lets their friction springs slip.
  void evaluate(collide::Part part, const Substep& step) {
    assert(part.end <= pairs().size() && pairs().size() <= force_.size());  // after find()
    penalty_kernels().evaluate(part, memory_.pairs, motion_.data(),
                               {layer().thickness, step.damper_limit, step.seconds,
                                step.sums_impacts && bounces() ? impulse_.data() : nullptr, returned_.data()},
                               force_.data());
  }
  /// Adds the forces that evaluate() has found.
  void add(const ForceBatch& batch) const;
  /// Returns the force (N) that it has found on the particle of an end.
  glm::dvec3 force(PenaltyEnd end) const { return double(end.sign()) * glm::dvec3(force_[end.pair]); }
  /// Returns what all pairs store between the gathered particles, in J. So many threads measure it.
  double stored_energy(collide::Workers& workers, int threads);
  /// Returns true if a pair of the frame has restitution.
  bool bounces() const { return !impulse_.empty(); }
  /// Adds what one end of a pair has done to the motion of the two: an impulse (N s) along n, and the energy (J) that
  /// this has taken. Ends of one pair may be added at the same time.
  void add_impact(PenaltyEnd end, double impulse, double taken);
  /// Adds what the pairs with restitution have done in the frame.
  void take_impacts(Rebounds& rebounds);

  /// Returns the ends of pairs that fall to a batch.
  std::span<const PenaltyEnd> ends_of(const Batch& batch) const;
  /// Returns what the law stores for a pair, in J, when a has moved by `way` (m) along b from x.
  double energy(std::size_t pair, Field<const float> x, const glm::dvec3& way = glm::dvec3(0.0)) const;
  /// Returns an upper bound of the work (J) that a pair does on one particle while the other moves by `way` (m).
  double max_work(std::size_t pair, Field<const float> x, double way) const;
  /// Upper bounds of how fast the force on a falls with the motion of a, in N/m.
  struct Slopes {
    float spring, damper;                // along n
    float across_spring, across_damper;  // while it sticks
  };
  /// Returns those of the coming `seconds`, in which dampers have no limit.
  Slopes slopes(std::size_t pair, Field<const float> x, Field<const float> v, float seconds) const;

 private:
  friend struct PenaltyTestAccess;  // for tests that make pairs by hand
  /// Those of a batch, in the order of their slots.
  collide::Part particles_of(const Batch& batch) const {
    return pairs().empty() ? collide::Part{} : of_batch_[batch.index];
  }
  void gather(collide::Part particles, Field<const float> x, Field<const float> v);
  void take(const DetectedContacts& detected, const State& state, collide::Workers& workers, int threads);
  void group(std::size_t slots, std::span<const Batch> batches, collide::Workers& workers, int threads);
  void set_traits(const State& state, const Batch& batch);
  void carry_over(collide::Part part, std::span<const collide::Contact> before, const VectorArray& stretch);
  template <class Real>
  auto law_of(std::size_t pair) const;
  glm::vec3 between(std::size_t pair, Field<const float> x) const;

  Memory memory_;
  LaneArray<glm::vec4> force_;  // on a, of the current substep, N
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
