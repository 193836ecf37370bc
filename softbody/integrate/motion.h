#pragma once
// What integrators are made of: forces, contacts and the arithmetic on the vectors of all particles. Each function acts
// on one batch, or on the part of a share; the arithmetic leaves lanes alone that do not move. Whatever changes
// velocities leaves held particles theirs.

#include <vector>

#include "softbody/integrate/batch_shares.h"
#include "softbody/integrate/contact_pass.h"
#include "softbody/integrate/plan.h"
#include "softbody/mechanics/force_set.h"
#include "softbody/state/state.h"

namespace softbody {

class ImplicitSteps;
struct Integrator;

/// One vector for each particle, which integrators compute with.
struct Quantity {
  int index;
};
inline constexpr Quantity positions{0}, velocities{1}, forces{2};
constexpr Quantity scratch(int i) { return {3 + i}; }

/// What a Motion acts on. All of these must outlive it.
struct MotionParts {
  State& state;
  Hand& hand;
  PenaltyContact& penalty;
  SolidContact& solids;
  ContactPass& contacts;
  ImplicitSteps& implicit;
};

class Motion {
 public:
  explicit Motion(const MotionParts& parts) : parts_(parts), forces_({parts.penalty, parts.hand}) {}

  void set_plan(const Plan& plan);
  /// gravity in m/s^2, wind in m/s.
  void begin_frame(const Integrator& integrator, const glm::dvec3& gravity, const glm::dvec3& wind,
                   const BatchShares& shares);
  /// h: of the coming substeps of this integrator, s.
  void begin_substeps(const Integrator& integrator, float h);

  /// Shows contact_forces() a batch as it is now. Needs a barrier after it.
  void show(const Batch& batch);
  /// Evaluates the penalty contacts of the share's part, for all_forces() of all batches. h: s, for which friction
  /// slips. The batches are those of the start of a frame, or of the last show().
  void contact_forces(const BatchShare& share, float h);
  void all_forces(const Batch& batch);  // at the current positions and velocities
  /// Does what all_forces() and kick() do together, faster, and drift() where nothing else acts on the batch.
  void advance_velocities(const BatchShare& share, const Batch& batch, float h, Volumes how);
  /// Ends a substep that advance_velocities() has begun: drift() where it has not done so, and show().
  void advance_positions(const BatchShare& share, const Batch& batch, float h);
  void other_forces(const Batch& batch);    // all but those that project() and pull() stand for
  void kick(const Batch& batch, float h);   // v += h (f / m + g)
  void accelerations(const Batch& batch);   // f = f / m + g
  void drift(const Batch& batch, float h);  // x += h v
  /// Tells contacts that what has acted until now is no impact of theirs.
  void note_velocities(const Batch& batch) { parts_.solids.note_velocities(batch); }
  /// Changes the velocities so that in a step of h from here surfaces do not pass through each other, nor particles
  /// into solids. The velocities of all batches must be there. Needs a barrier after it.
  void contacts(const BatchShare& share, float h) { parts_.contacts.apply(share, h); }
  /// Does the same after advance_velocities() with Volumes::implicit_, so that the pressure is the one at the end.
  void contacts_under_pressure(const BatchShare& share, float h);
  /// Does the same for the positions that a substep of h ends with.
  void contacts_at_end(const BatchShare& share, float h) { parts_.contacts.apply(share, h, h); }
  /// XPBD, on displacements d in this step of h, which starts at x0. Wants the positions to be x0 + d.
  void project(const Batch& batch, Quantity x0, Quantity d, float h);
  /// Adds what the hand does in a step of h to velocities that hold what all else does, after other_forces().
  void pull(const Batch& batch, float h);
  /// Solves for the end of an implicit step of h: `mean` becomes the velocities that lead there, and `rest` what is to
  /// be added to them after drift(). Wants contact_forces() and the positions and velocities of all batches.
  void solve_implicit(const BatchShare& share, const Batch& batch, Quantity mean, Quantity rest, float h);
  /// Sums the work that moving holds have done on a batch in a substep of h, and moves them on. Wants contact_forces().
  void count_work_of_holds(const BatchShare& share, const Batch& batch, float h);
  void copy(const Batch& batch, Quantity from, Quantity to);           // to = from
  void add(const Batch& batch, Quantity to, float times, Quantity q);  // to += times q
  void scale(const Batch& batch, Quantity q, float times);             // q *= times
  void clear(const Batch& batch, Quantity q);                          // q = 0

 private:
  VectorArray& array(Quantity q);
  Field<float> v(const Batch& b) { return field(parts_.state.v, b.base); }
  Field<float> f(const Batch& b) { return field(parts_.state.f, b.base); }
  glm::dvec3 acceleration_of(const Batch& b) const { return uniform_acceleration(*b.model, gravity_, wind_); }
  ForceBatch step_of(const Batch& batch, float h) {
    return {parts_.state, batch, double(h), acceleration_of(batch), f(batch)};
  }

  /// True if contacts, the hand or holds may act on the batch after its forces.
  bool is_acted_on(const BatchShare& share, const Batch& b) const {
    return parts_.contacts.may_touch(share, b) || parts_.hand.holds(parts_.state, b) || parts_.state.held.any(b);
  }
  void impose_holds(const Batch& b) { parts_.state.held.impose(b, field(parts_.state.v)); }

  MotionParts parts_;
  ForceSet forces_;
  std::vector<VectorArray> scratch_;
  std::vector<LaneVolumes> volumes_;     // of each batch
  std::vector<VectorArray> own_forces_;  // of each thread, room for those on a batch: they stay in the cache; 0
  glm::dvec3 gravity_{0.0}, wind_{0.0};
  float h_ = 0;
  PenaltyContact::Substep penalty_step_{};
};

}  // namespace softbody
