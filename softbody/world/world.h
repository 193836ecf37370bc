#pragma once
// A scene in motion. One step() is one frame: bodies arrive, respond to the contacts found last, and move; then
// contacts are detected at the new positions, and bodies that rest fall asleep. All that can be read afterwards
// (positions, contacts, boxes) belongs to the same instant.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "collide/methods.h"
#include "softbody/contact/contacts.h"
#include "softbody/forces/grab.h"
#include "softbody/forces/pair_energy.h"
#include "softbody/integrate/integrators.h"
#include "softbody/integrate/max_work.h"
#include "softbody/integrate/plan.h"
#include "softbody/scene/scene.h"
#include "softbody/state/body.h"
#include "softbody/state/isa.h"

namespace softbody {

struct BodyModel;
struct Snapshot;

/// What the last step did. Before the first step all numbers but detect_ms are 0.
struct StepReport {
  double detect_ms = 0, solve_ms = 0, total_ms = 0;  // for display only: nothing in the simulation depends on a clock
  double time = 0;                                   // s, simulated since the start, this step included
  /// Simulated in this step: less than frame_time() if a whole frame would exceed the bounds of work.
  double seconds = 0;
  int substeps = 0;
  double last_substep = 0;  // s, its length
  /// The integrator that moved the bodies; the chosen one if no step was done since the choice.
  const Integrator* integrator = nullptr;
  std::string_view why;      // it was this integrator; empty unless it was chosen automatically
  bool adds_energy = false;  // surface contact pushed overlapping bodies apart, or threw colliding ones back
};

/// A body that the scene did not bring.
struct AddedBody {
  BodyId body;
  BodySource source;  // with which a scene would bring it, in the same frame to the same place
};

class World {
 public:
  struct Options {
    int threads = 1;
    double frame_time = 1.0 / 60.0;  // s
    IntegratorChoice integrator{};
    Isa isa = best_isa();
    /// Fewer particles of moving bodies are moved by one thread: it is done before the others have woken up.
    std::size_t min_shared_particles = 20'000;
    MaxWork max_work{};
  };

  /// Throws SceneError if a frame would take more than max_substeps, because a material is too stiff for its mass or
  /// the tolerance is too wide.
  World(Scene scene, const Options& options);

  /// Calls `after_substep` after each substep. It may read positions(), which are up to date; nothing else is, and it
  /// must not change the world.
  void step(const std::function<void()>& after_substep = {});
  /// Returns all that decides how the world goes on.
  Snapshot snapshot() const;
  /// Puts the world into the state of the snapshot, settings included, and detects. It then goes on, to the bit, as the
  /// world of the snapshot did, which may be another world. Its threads, frame time and isa stay.
  void restore(const Snapshot& snapshot);

  // Changes between frames. Each detects again if contacts may have changed.
  /// Places the body's particles, wakes all bodies and detects. `particles`: finite, one for each vertex.
  void set_particles(BodyId body, std::span<const Particle> particles);
  /// Adds `count` bodies at the scene's dropper, or else above its first body, each above whatever is in the way;
  /// several are spread more widely than one. Returns the last of them. Throws SceneError as the constructor does, and
  /// then adds none.
  BodyId drop(int count = 1);
  /// Adds a body now, and free, whatever frames the source says. Throws SceneError as the constructor does.
  BodyId add(const BodySource& source);
  /// Throws a body of the kind that drop() adds. It appears at the first clear place of the flight that begins at
  /// `from` (m) with `velocity` (m/s, not 0). Returns nothing if there is no clear place.
  std::optional<BodyId> throw_body(const glm::dvec3& from, const glm::dvec3& velocity);
  /// Returns the bodies of drop(), add() and throw_body() that were not removed, in the order in which they came.
  const std::vector<AddedBody>& added() const;
  /// Removes a body and wakes its neighbours. The ids of later bodies, and their vertices, move up.
  void remove(BodyId body);
  /// Lets the hand grab a body, or another point or target; there is one hand. nullopt: the hand lets go. A grabbed
  /// body wakes, stays awake, and is no longer held in place.
  void grab(const std::optional<Grab>& grab);
  const std::optional<Grab>& grabbed() const;

  // Changes of the scene. They wake all bodies and make a new plan. Values must be such as a scene file allows.
  void set_gravity(const glm::dvec3& gravity);  // m/s^2
  /// Changes a material of the scene, or adds one for bodies to come if `index` is the number of materials; its name
  /// must then be new. Bodies go on from where they are, and new ones start in the shape that they would have started
  /// in before. Throws SceneError, and changes nothing, if the material is too stiff.
  void set_material(std::size_t index, const Material& material);
  void set_solids(const Scene& from);                // takes over the solids of that scene, the ground included
  void set_contact_surface(ContactSurface surface);  // throws SceneError as the constructor does
  /// Throws SceneError as the constructor does. The choice's key must be known.
  void set_integrator(const IntegratorChoice& choice);
  void set_method(std::string_view key);  // of a known method
  /// problem(settings) must be empty.
  void set_collision(const collide::Settings& settings, bool default_cell_size);

  const Scene& scene() const;                  // with all changes
  const collide::Settings& collision() const;  // the scene's, with the cell size in use
  const collide::Method& method() const;
  const IntegratorChoice& integrator_choice() const;
  const Plan& plan() const;
  int frame() const;  // steps done
  double frame_time() const;

  // The current state.
  const collide::Bodies& bodies() const;
  std::span<const BodyId> vertex_body() const;  // the body of each vertex
  collide::Frame positions() const;             // in the world, valid until the next change
  Particle particle(BodyId body, Index vertex) const;
  BodyState body(BodyId body) const;
  const BodyModel& model(BodyId body) const;
  const collide::Result& detection() const;   // at positions()
  const collide::Detector& detector() const;  // for its debug()
  bool all_at_rest() const;                   // all bodies are asleep, and none is still to come
  int needed_substeps() const;                // that the bounds ask for in a frame from the current state
  std::uint64_t state_hash() const;           // over the bits of positions and velocities, in the order of bodies

  // The last step.
  const StepReport& last_step() const;
  PairEnergies pair_energies() const;
  std::vector<SurfaceContactPoint> surface_contacts() const;  // while all bodies sleep: of the last substep before

 private:
  friend struct WorldTestAccess;  // for tests of the solver
  struct State;
  struct DeleteState {
    void operator()(State* state) const;
  };
  std::unique_ptr<State, DeleteState> state_;
};

/// Returns the scene's bodies and the added ones. A world of a scene with these goes the same way to the bit, if hands
/// changed nothing else and the plan of a lone body did not change for company.
std::vector<BodySource> body_sources(const World& world);

}  // namespace softbody
