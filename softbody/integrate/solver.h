#pragma once
// The solver moves all bodies of a world, frame by frame: it owns their state and everything that acts on it.

#include <functional>
#include <memory>
#include <vector>

#include "softbody/forces/hand.h"
#include "softbody/forces/penalty_contact.h"
#include "softbody/integrate/contact_pass.h"
#include "softbody/integrate/crew.h"
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
  ContactLayer layer;
  PenaltyPairs penalty_pairs;
  std::vector<SolidPush> pushes;
  Rebounds rebounds;
  SurfaceContact::State surface;
  StepController::Hysteresis substep_hysteresis;

  std::size_t bytes() const;
};

class Solver {
 public:
  /// The scene must outlive this.
  Solver(const Scene& scene, const Crew& crew);
  Solver(const Solver&) = delete;
  ~Solver();

  State& state() { return state_; }
  const State& state() const { return state_; }
  Hand& hand() { return hand_; }
  const Hand& hand() const { return hand_; }
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
  void forget_impacts(BodyId body) { state_.memory(body).impact = {}, rebounds_.forget(body); }
  /// Takes the contacts for the coming frame of `seconds`.
  void set_contacts(const DetectedContacts& detected, double seconds) {
    penalty_.find(detected, state_, seconds, crew_.workers());
  }
  /// Bodies may come closer than the tolerance from now on: the layer of penalty contact grows anew, from nothing.
  void let_bodies_closer() { penalty_.layer = {}; }

  /// Advances by `seconds`, or by less if the budget of work is spent, or if there are too many candidates of surface
  /// contact on the way. If there are at the start, throws std::length_error; then nothing has moved. Unless substeps
  /// are fixed, their bound is measured anew as bodies move, since bodies that are crushed may need any number of
  /// substeps and have many contacts. after_substep: called by one thread while the others wait.
  FrameResult advance(double seconds, const std::function<void()>& after_substep = {});
  /// Ends a frame of `seconds`, after advance(): applies what resists the bodies' motion as a whole, lets their origins
  /// follow, notes how fast they are, and writes all positions to `places` as write_positions() does.
  void finish_frame(double seconds, Field<float> places);
  /// Writes the positions of all particles in the world, in the order of the world's vertices.
  void write_positions(Field<float> to) const;
  double last_substep() const { return double(last_substep_); }  // s, how long it was

  SolverState save() const;
  /// Goes on from there. The plan and the integrator stay as they are set.
  void restore(const SolverState& saved);

 private:
  friend struct SolverTestAccess;  // for a benchmark of its stages
  /// A frame in progress.
  struct Frame {
    double left;            // s
    std::size_t particles;  // that move
    StepBound bound;        // as it was measured last
    int substeps = 0, needed = 0;
    MomentumRestorer momenta{};
  };

  glm::dvec3 gravity() const;
  void mark_pushed(BodyId body) { pushed_[state_.body(body).batch] |= 1u << state_.body(body).lane; }
  void join(BodyId body);
  double penalty_energy();
  void finish(const Batch& batch, double seconds);
  Frame begin_frame(double seconds);
  void take_substeps(Frame& frame, const std::function<void()>& after_substep);
  void set_staggering(double h, bool first);
  void prepare_implicit(float h);
  void share_batches(bool in_step);
  void run(int substeps, float h, bool first, const std::function<void()>& after_substep);

  const Scene& scene_;
  Crew crew_;
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
  bool has_gravity_ = false;
  std::vector<unsigned> pushed_;  // of each batch, bits: lanes that something may push in this frame
  std::vector<char> joined_;      // of each batch: whether contacts may join it to others, or act within it
  float last_substep_ = 0;        // s
};

}  // namespace softbody
