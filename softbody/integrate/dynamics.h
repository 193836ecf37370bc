#pragma once
// The state of all bodies and the operations that integrators are made of: contact forces, forces, kick, solids, drift.

#include <functional>
#include <memory>
#include <optional>

#include "softbody/contact/solid_features.h"
#include "softbody/contact/surface_contact.h"
#include "softbody/forces/force_set.h"
#include "softbody/integrate/crew.h"
#include "softbody/integrate/dynamics_state.h"
#include "softbody/integrate/integrators.h"
#include "softbody/integrate/kernels.h"
#include "softbody/integrate/max_work.h"
#include "softbody/integrate/momentum_restorer.h"
#include "softbody/integrate/plan.h"
#include "softbody/integrate/resistance.h"
#include "softbody/integrate/substeps.h"
#include "softbody/model/body_model.h"
#include "softbody/scene/scene.h"

namespace softbody {

class ImplicitFrames;
class ImplicitMatrix;
struct ImplicitSteps;
struct ImplicitWork;

/// A field over all particles that integrators compute with.
struct Quantity {
  int index;
};
inline constexpr Quantity positions{0}, velocities{1}, forces{2};
constexpr Quantity scratch(int i) { return {3 + i}; }

/// Contacts that a detector has found.
struct DetectedContacts {
  const collide::Bodies& vertices;
  std::span<const BodyId> vertex_body;  // the body of each vertex
  const std::vector<collide::Contact>& contacts;
};

/// What a frame has simulated.
struct FrameResult {
  int substeps = 0;
  double seconds = 0;
};

class Dynamics {
 public:
  Dynamics(const Scene& scene, const Crew& crew, Isa isa)
      : scene_(scene),
        crew_(crew),
        wide_(kernels(isa, lanes)),
        narrow_(kernels(isa, one_lane)),
        isa_(isa),
        force_set_(isa) {}

  BodyId add(std::shared_ptr<const BodyModel> model, const glm::dvec3& position, const glm::dvec3& velocity);
  /// Removes a body; the ids of later bodies move up by one. The bodies of set_vertices() must still contain it.
  void remove(BodyId body);
  /// Bodies of the model `from` go on as bodies of `to`, of the same mesh, from where they are.
  void replace(const std::shared_ptr<const BodyModel>& from, const std::shared_ptr<const BodyModel>& to);
  /// What pulls a body; nothing: nobody does. The plan must have the hand's stage while one does.
  void grab(const std::optional<Grab>& grab) { grab_ = grab; }
  const std::optional<Grab>& grabbed() const { return grab_; }
  glm::dvec3 grabbed_point() const;  // m; of the body that is grabbed
  void set_plan(const Plan& plan);
  void set_integrator(const Integrator& integrator);
  /// The one that the last frame was integrated with, and, if it was chosen automatically, why.
  const Integrator& used_integrator() const { return *integrator_; }
  std::string_view why_integrator() const { return why_; }
  double last_substep() const { return double(step_); }  // s, how long it was
  /// The substeps of a frame: as many as the bound asks for, or exactly this many of the integrator's.
  void set_fixed_substeps(std::optional<int> count) { fixed_substeps_ = count; }
  void set_max_work(const MaxWork& max) { max_work_ = max; }
  /// A body that sleeps or is held is not integrated; one that falls asleep also loses its velocities.
  void pin_body(BodyId body, bool pinned, int release);
  /// One a vertex, finite. The body's origin goes to their middle.
  void set_particles(BodyId body, std::span<const Particle> particles);
  void set_asleep(BodyId body, bool asleep);

  /// Sets the contacts for the coming frame. thickness: of the contact layer, m.
  void set_contacts(const DetectedContacts& detected, float thickness);
  /// Stored energy (J) of each pair: of the last frame's pairs now; of `detected`, if applied now.
  std::vector<PairEnergy> penalty_energies() const;
  std::vector<PairEnergy> penalty_energies(const DetectedContacts& detected, float thickness) const;

  /// For surface contact: where bodies' vertices are in frames. The bodies must outlive this.
  void set_vertices(const collide::Bodies& vertices) { vertices_ = &vertices; }

  /// Advances by `seconds`, or by less if a limit of substeps or work is reached. Unless substeps are fixed, their
  /// bound is computed anew as bodies move, since bodies that are crushed may need any number of substeps and have many
  /// contacts. after_substep: called by one thread while the others wait.
  FrameResult advance(double seconds, const std::function<void()>& after_substep = {});
  /// Returns the substeps that the bound asks for in the present state.
  int needed_substeps(double seconds) const;
  /// Once a frame of `seconds`, after advance(): what resists the bodies' motion as a whole, then their origins follow.
  void finish_frame(double seconds);

  // What integrators are made of, beside what a Worker says. The arithmetic leaves lanes alone that do not move.
  void contact_forces(const Worker& worker, float h);  // of its part of the contacts, for all_forces() of all
  void all_forces(Batch& batch);                       // at the current positions and velocities
  void other_forces(Batch& batch);                     // all but those that project() and pull() stand for
  void kick(Batch& batch, float h);                    // v += h (f / m + g)
  void accelerations(Batch& batch);                    // f = f / m + g
  void drift(Batch& batch, float h);                   // x += h v
  /// On the velocities, so that in a step of h from here surfaces do not pass through each other nor particles into
  /// solids. All velocities must be there; needs a barrier after it.
  void contacts(const Worker& worker, float h) { contacts(worker, h, 0); }
  /// The same for the positions that a substep of h ends with.
  void contacts_at_end(const Worker& worker, float h) { contacts(worker, h, h); }
  /// XPBD, on displacements d in this step of h, which starts at x0; the positions have to be x0 + d.
  void project(Batch& batch, Quantity x0, Quantity d);
  /// What the hand does in a step, on velocities that hold what all else does. For who takes other_forces().
  void pull(Batch& batch);
  /// Solves for the end of an implicit step of h: `mean` becomes the velocities that lead there, and `rest` what is to
  /// be added to them after drift(). Wants contact_forces() and the positions and velocities of all bodies.
  void solve_implicit(const Worker& worker, Batch& batch, Quantity mean, Quantity rest, float h);
  void copy(Batch& batch, Quantity from, Quantity to);           // to = from
  void add(Batch& batch, Quantity to, float times, Quantity q);  // to += times q
  void scale(Batch& batch, Quantity q, float times);             // q *= times
  void clear(Batch& batch, Quantity q);                          // q = 0

  // Reading.
  const SurfaceContact& surface_contact() const { return surface_; }
  std::size_t body_count() const { return bodies_.size(); }
  const Body& body(BodyId id) const { return bodies_[id]; }
  const BodyModel& model(BodyId id) const { return *batches_[bodies_[id].batch].model; }
  Particle particle(BodyId id, Index vertex) const;
  double max_particle_speed(BodyId id) const;  // m/s, of its particles
  /// N s, what solids gave to a body along their normals in the last advance().
  glm::dvec3 solid_impulse(BodyId id) const;
  /// World positions, bodies in order of their ids. Every span has one value a vertex.
  void world_positions(std::span<float> x, std::span<float> y, std::span<float> z) const;
  std::uint64_t hash() const;  // FNV-1a over the bits of origins, positions and velocities in order of the ids
  DynamicsState save() const;
  /// Goes on from there; the plan and the integrator stay as they are set.
  void restore(const DynamicsState& state);
  void set_calm_frames(BodyId id, int frames) { bodies_[id].calm_frames = frames; }

 private:
  using Components = std::array<LaneArray<float>, 3>;

  std::size_t slot(const Body& body, Index vertex) const {
    const Batch& b = batches_[body.batch];
    return b.base + std::size_t(vertex) * std::size_t(b.width) + std::size_t(body.lane);
  }
  Field<float> at(Components& c, const Batch& b) {
    return {c[0].data() + b.base, c[1].data() + b.base, c[2].data() + b.base};
  }
  Field<const float> at(const Components& c, const Batch& b) const {
    return {c[0].data() + b.base, c[1].data() + b.base, c[2].data() + b.base};
  }
  BatchView view(const Batch& b) { return {b, kernels_of(b), at(x_, b), at(v_, b)}; }
  const Kernels& kernels_of(const Batch& b) const { return b.width == one_lane ? narrow_ : wide_; }
  Batch& batch_with_free_lane(const std::shared_ptr<const BodyModel>& model);
  std::size_t append(std::size_t values);
  void widen(Batch& batch);
  Components& components(Quantity q);
  template <class Operation>
  void each_value(Batch& batch, Operation operation);
  template <class Act>
  void with_forces(Batch& batch, Act act);
  void contacts(const Worker& worker, float h, float since_start);
  void surface_contacts(const Worker& worker, float h, float since_start);
  void solids(const Worker& worker, float h);
  void solids(Batch& batch, float h);
  bool particles_on_solids(Batch& batch, float h, bool again);
  void find_solid_features(Batch& batch, int lane, std::span<const SolidCore> cores, const Approach& approach);
  bool solid_features(Batch& batch, float h);
  bool solid_feature(Batch& batch, SolidFeature& feature);
  void move_lane(Batch& batch, int from, int to);
  static bool moves(const Batch& batch);
  std::size_t particle_count() const;                   // of all bodies, those that do not move too
  double max_particle_speed(const Batch& batch) const;  // m/s, of its particles
  Extent extent(const Batch& batch, const Components& boxed, const Components& measured) const;
  double max_travel(const Batch& batch, const Extent& extent, int lane, double seconds) const;
  glm::vec3 vertex_normal(const Body& body, Index vertex) const;
  void find_pairs(const DetectedContacts& detected, std::vector<std::uint32_t>& contacts_of,
                  std::vector<PenaltyPair>& pairs) const;
  glm::vec3 contact_normal(const PenaltyPair& pair, Index vertex_a, Index vertex_b) const;
  void find_surface_contacts(double left, double ahead, double least);
  int predicted_substeps(double left, double h) const;
  void wake_hit_sleepers(double seconds);
  void prepare_solids(Batch& batch, double seconds);
  template <class Solid>
  void prepare_solid(Batch& batch, const Extent& extent, double seconds, const Solid& solid);
  /// Of a frame.
  struct Progress {
    double seconds, left;
    int substeps = 0;
    int fixed = 0;         // substeps that it is to take; 0: as many as are needed
    int max_substeps = 0;  // that there may be
    MomentumRestorer momenta{};
  };
  void begin_frame(double seconds);
  bool out_of_budget(const Progress& frame) const;
  void take_substeps(Progress& frame, const std::function<void()>& after_substep);
  int substeps_left(const Progress& frame, int stable) const;
  int substeps_within_bound(double h) const;
  int plan_substeps(const Progress& frame);
  void raise_min_substep_rate(const SubstepBound& bound, double seconds);
  int max_explicit_substeps() const;
  SubstepBound bound(double seconds) const;  // in the state at hand
  static int count_substeps(const SubstepBound& bound, double seconds, double at_least);
  ForceBound own_bound(const Batch& batch) const;  // of the body for which it is largest
  double rounding_velocity(double step) const;
  void choose_integrator(double seconds);
  void resize_scratch();
  void prepare_implicit(float h);
  void count_implicit_work();
  const ImplicitMatrix& implicit_matrix(const Batch& batch, double h) const;
  std::array<bool, lanes> find_planes(const Batch& batch, const ImplicitFrames& frames, ImplicitWork& work,
                                      double h) const;
  std::array<bool, lanes> find_penalty_pairs(const Batch& batch, ImplicitWork& work, double h) const;
  void correct_solver_momentum(const Batch& batch, const ImplicitFrames& frames, ImplicitWork& work,
                               const std::array<bool, lanes>& which, double h) const;
  std::array<bool, lanes> second_order_step(const Batch& batch, const ImplicitFrames& frames, ImplicitWork& work,
                                            double h) const;
  void first_order_step(const Batch& batch, const ImplicitFrames& frames, ImplicitWork& work, double h) const;
  void run(int substeps, float h, bool first, const std::function<void()>& after_substep);
  void mark_contacted(BodyId id) { batches_[bodies_[id].batch].contacted |= 1u << bodies_[id].lane; }
  void recentre_origin(BodyId id);
  void update_moves(const Body& body);

  const Scene& scene_;
  Crew crew_;
  const Kernels &wide_, &narrow_;
  Isa isa_;
  const Integrator *chosen_ = nullptr, *integrator_ = nullptr;
  std::string_view why_;
  std::optional<int> fixed_substeps_;
  ForceSet force_set_;
  Resistance resistance_;
  bool has_gravity_ = false, has_restitution_ = false;
  std::vector<Batch> batches_;
  std::vector<Body> bodies_;
  Components x_, v_, f_;
  // Room of bound(): not for two threads at once.
  mutable Components area_;
  mutable std::vector<float> penalty_damping_;
  std::vector<Components> scratch_;
  Components before_;  // velocities at the start of the substep, if the scene has restitution
  std::shared_ptr<ImplicitSteps> implicit_steps_;  // what they keep; none before the first
  PenaltyContact& penalty_ = force_set_.of<PenaltyContact>();
  SurfaceContact surface_;
  bool has_surface_ = false, self_contact_ = false, has_solid_features_ = false;
  std::vector<float> since_found_;  // s, as each thread counts them
  double found_ = 0;                // s before the end of the frame, when surface_ was found; 0: not yet
  const collide::Bodies* vertices_ = nullptr;
  std::array<std::vector<float>, 3> world_positions_, velocity_;  // world, for surface_
  std::vector<PenaltyPair> pairs_before_;                         // of the frame before
  std::vector<std::uint32_t> contacts_of_;                        // a vertex, in the frame at hand
  std::optional<Grab>& grab_ = force_set_.of<Hand>().grab;
  float step_ = 0;  // s, of the substep at hand
  SubstepHysteresis substep_hysteresis_;
  MaxWork max_work_;
  double surface_work_ = 0, implicit_ = 0, penalty_work_ = 0;  // of the frame at hand, as max_work_ counts them
};

}  // namespace softbody
