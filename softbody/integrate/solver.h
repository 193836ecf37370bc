#pragma once
// The solver moves all bodies of a world, frame by frame: it owns their state and everything that acts on it.

#include <functional>
#include <memory>
#include <vector>

#include "softbody/forces/hand.h"
#include "softbody/forces/penalty_contact.h"
#include "softbody/integrate/batch_shares.h"
#include "softbody/integrate/contact_pass.h"
#include "softbody/integrate/momentum_restorer.h"
#include "softbody/integrate/motion.h"
#include "softbody/integrate/resistance.h"
#include "softbody/integrate/step_bounds.h"
#include "softbody/scene/scene.h"
#include "softbody/state/state.h"

namespace softbody {

/// What a frame has simulated.
struct FrameResult {
  int substeps = 0;
  int needed = 0;  // of a whole frame, see StepPlan: the fewest that any part of this one asked for
  double seconds = 0;
};

/// Everything that the solver remembers from one frame to the next.
struct SolverState {
  State bodies;
  PenaltyContact::Memory penalty;
  std::vector<SolidPush> pushes;
  Rebounds rebounds;
  SurfaceContact::State surface;
  StepController::Hysteresis substep_hysteresis;

  std::size_t bytes() const;
};

class Solver {
 public:
  using AfterSubstep = std::function<void()>;

  /// The scene must outlive this.
  Solver(const Scene& scene, const BatchShares& shares);
  Solver(const Solver&) = delete;
  ~Solver();

  State& state() { return state_; }
  const State& state() const { return state_; }
  Hand& hand() { return hand_; }
  StepController& steps() { return steps_; }
  const StepController& steps() const { return steps_; }
  const SurfaceContact& surface_contact() const { return contacts_.surfaces(); }
  const SolidContact& solid_contact() const { return solids_; }
  const PenaltyContact& penalty_contact() const { return penalty_; }

  /// Takes the world's list of bodies, which must outlive this and change with the state.
  void set_vertices(const collide::Bodies& vertices) { contacts_.set_vertices(vertices); }
  void set_plan(const Plan& plan);
  void set_max_candidates(const MaxCandidates& max) { contacts_.set_max_candidates(max); }
  /// Removes a body. The world's list of bodies must still contain it.
  void remove(BodyId body);

  /// Forgets the impacts of a body that has been put elsewhere.
  void forget_impacts(BodyId body) {
    state_.memory(body).impact = {};
    rebounds_.forget(body);
  }
  /// Takes the contacts for the coming frame of `seconds`.
  void set_contacts(const DetectedContacts& detected, double seconds) {
    penalty_.find(detected, state_, seconds, shares_.workers());
  }
  /// Bodies may come closer than the tolerance from now on: the layer of penalty contact grows anew, from nothing.
  void let_bodies_closer() { penalty_.reset_layer(); }

  /// Advances by `seconds`, or by less if the budget of work is spent, or if there are too many candidates of surface
  /// contact on the way. If there are at the start, throws std::length_error; then nothing has moved. Unless substeps
  /// are fixed, their bound is measured anew as bodies move, since bodies that are crushed may need any number of
  /// substeps and have many contacts. after_substep: called by one thread while the others wait.
  FrameResult advance(double seconds, const AfterSubstep& after_substep = {});
  /// Ends a frame of `seconds`, after advance(): applies what resists the bodies' motion as a whole, lets their origins
  /// follow, notes how fast they are, and writes the positions of all particles in the world to `places`, in the order
  /// of the world's vertices.
  void finish_frame(double seconds, Field<float> places);
  double last_substep() const { return double(last_substep_); }  // s, how long it was

  SolverState save() const;
  /// Goes on from there. The plan and the integrator stay as they are set.
  void restore(const SolverState& saved);

 private:
  friend struct SolverTestAccess;  // for a benchmark of its stages
  /// Substeps of one length, taken until it has to be looked again whether they are short enough.
  struct Series {
    double left;      // s, of the frame, when it begins
    double substeps;  // that this is divided into; no int may hold it
    int trusted = 0;  // the most of them that may be taken
    int taken = 0;

    double h() const { return left / substeps; }  // s
    double left_after() const { return taken == substeps ? 0 : left - taken * h(); }
  };

  void mark_pushed(BodyId body) { pushed_[state_.body(body).batch] |= 1u << state_.body(body).lane; }
  void join(BodyId body);
  /// Returns what the pairs of the frame hold at its start or after the last substep, in J.
  double penalty_energy() { return penalty_.stored_energy(shares_.workers(), shares_.active()); }
  void finish(const Batch& batch, double seconds);
  std::size_t take_moving_batches();
  void mark_touched();
  /// Returns what bounds the steps at the frame's start.
  StepBound begin_frame(double seconds);
  /// Takes the substeps of a frame of `seconds` in series, and restores what rounding has done to the momenta.
  FrameResult take_substeps(double seconds, StepBound bound, const AfterSubstep& after_substep);
  /// Plans the next series: into how many substeps the last `left` seconds of the frame are divided. The candidates of
  /// surface contact, which it finds, add to the bound.
  Series plan_series(double left, StepBound& bound);
  int trusted_substeps(const Series& series, double fastest, bool surfaces_decide) const;
  void count_work(int count);
  double work_of_wind() const;
  double staggering(float h) const;
  void set_staggering(double seconds);
  void prepare_implicit(float h);
  void share_batches(bool in_step);
  /// Takes `count` substeps of h. first: of the frame.
  void run(int count, float h, bool first, const AfterSubstep& after_substep);

  const Scene& scene_;
  BatchShares shares_;
  State state_;
  Hand hand_;
  PenaltyContact penalty_;
  SolidContact solids_;
  ContactPass contacts_;
  std::unique_ptr<ImplicitSteps> implicit_;
  Motion motion_;
  Resistance resistance_;
  Rebounds rebounds_;
  StepController steps_;
  StepBounds bounds_;
  bool has_holds_ = false;        // the plan has them
  glm::dvec3 gravity_{0.0};       // m/s^2; 0 if the plan has none
  std::vector<unsigned> pushed_;  // of each batch, bits: lanes that something may push in this frame
  std::vector<char> joined_;      // of each batch: whether contacts may join it to others, or act within it
  float last_substep_ = 0;        // s
};

}  // namespace softbody
