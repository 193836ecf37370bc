#pragma once
// A world simulates a scene. One step() is one frame: bodies arrive, respond to the contacts found last, and move; then
// contacts are detected at the new positions, and bodies at rest fall asleep. Everything that can be read afterwards
// (positions, contacts, boxes) belongs to the same instant.
//
// If the scene has a recording, a step shows its next frame and detects, and nothing else: the plan leaves out all
// other stages. Who needs a solver asks the plan for Stage::integrate.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "collide/methods.h"
#include "softbody/contact/contacts.h"
#include "softbody/forces/grab.h"
#include "softbody/integrate/integrators.h"
#include "softbody/integrate/plan.h"
#include "softbody/integrate/work.h"
#include "softbody/scene/scene.h"
#include "softbody/state/body.h"

namespace softbody {

struct BodyModel;
struct Snapshot;
class State;

/// Report of the last step. Before the first step all numbers but detect_ms are 0.
struct StepReport {
  double detect_ms = 0, solve_ms = 0, total_ms = 0;  // for display only: nothing in the simulation depends on a clock
  double time = 0;                                   // s, simulated since the start, this step included
  /// Time simulated in this step in s: less than frame_time() if a whole frame would exceed the budget of work.
  double seconds = 0;
  int substeps = 0;
  int needed = 0;           // substeps that the stability bound asks for in a whole frame
  double last_substep = 0;  // s, its length
  /// The integrator that moved the bodies; the chosen one if no step was done since the choice.
  const Integrator* integrator = nullptr;
  std::string_view why;  // reason for this integrator; empty unless it was chosen automatically
};

/// A body that is not from the scene.
struct AddedBody {
  BodyId body;
  BodySource source;  // with which a scene would add it in the same frame at the same place
};

/// The meshes that are simulated: a coarse one where a fine one rides on it. Their contacts move the bodies, and the
/// oracle judges their surfaces. Valid until the next change of the world.
struct SimulatedMeshes {
  collide::Frame positions;
  std::span<const collide::Contact> contacts;  // that the detector found between their vertices
};

class World {
 public:
  struct Options {
    int threads = 1;
    double frame_time = 1.0 / 60.0;  // s
    IntegratorChoice integrator{};
    double least_share = collide::Workers::least_share;  // of work, which each thread is to have: ns
    WorkBudget budget{};
    MaxCandidates max_candidates{};
  };

  /// Throws SceneError if a body has too many particles for implicit steps, and these are chosen.
  World(Scene scene, const Options& options);

  /// Simulates one frame. Calls `after_substep` after each substep; it may read positions(), which are up to date, but
  /// nothing else, and must not change the world.
  void step(const std::function<void()>& after_substep = {});
  /// Shows a frame of the scene's recording, which it must have, and detects. step() does the same with the next frame,
  /// and goes on behind one that it could not read. Throws as Recording::frame() does, and then shows what it did
  /// before. If it is the detector that throws, the frame is shown, but detection() is not of it.
  void show_frame(int number);
  /// Returns everything that determines how the world continues.
  Snapshot snapshot() const;
  /// Puts the world into the state of the snapshot, settings included, and detects. It then continues, to the bit, as
  /// the world of the snapshot did, which may be another world. Its threads and frame time do not change.
  void restore(const Snapshot& snapshot);

  // Changes between frames. Each of them detects again if contacts may have changed. With a recording, bodies cannot be
  // changed: each throws SceneError, except that a hand may let go.
  /// Places the body's particles, wakes all bodies and detects. `particles`: finite, one for each vertex of the mesh
  /// that is simulated.
  void set_particles(BodyId body, std::span<const Particle> particles);
  /// Adds `count` bodies at the scene's dropper, or above its first body if it has none. Each appears above everything
  /// that is in the way; several are spread more widely than one. Returns the last of them. Throws SceneError, and then
  /// adds none, if the world would have more than max_particles.
  BodyId drop(int count = 1);
  /// Adds a body now, and not held; the frames of the source are ignored. Throws SceneError as the constructor and
  /// drop() do.
  BodyId add(const BodySource& source);
  /// Throws a body of the kind that drop() adds. It appears at the first clear place of the flight that begins at
  /// `from` (m) with `velocity` (m/s, not 0). Returns nothing if there is no clear place.
  std::optional<BodyId> throw_body(const glm::dvec3& from, const glm::dvec3& velocity);
  /// Returns the bodies of drop(), add() and throw_body() that were not removed, in the order in which they came.
  const std::vector<AddedBody>& added() const;
  /// Removes a body and wakes its neighbours. The ids of later bodies, and their vertices, move up.
  void remove(BodyId body);
  /// Lets the hand grab a body, or changes its point or target; there is one hand. nullopt: the hand lets go. A grabbed
  /// body wakes up, stays awake, and is no longer held in place.
  void grab(const std::optional<Grab>& grab);
  const std::optional<Grab>& grabbed() const;

  // Changes of the scene. They wake all bodies and make a new plan. Values must be within the limits of a scene file.
  void set_gravity(const glm::dvec3& gravity);  // m/s^2
  /// Changes a material of the scene. If `index` is the number of materials, adds one for later bodies; its name must
  /// then be new. Bodies keep their positions, and new bodies start in the same shape as before the change.
  void set_material(std::size_t index, const Material& material);
  void set_solids(const Scene& from);  // copies the solids of that scene, the ground included
  void set_contact_surface(ContactSurface surface);
  /// Throws SceneError as the constructor does. The choice's key must be known.
  void set_integrator(const IntegratorChoice& choice);
  void set_method(std::string_view key);  // of a known method
  /// problem(settings) must be empty.
  void set_collision(const collide::Settings& settings, bool default_cell_size);

  const Scene& scene() const;                  // with all changes
  const collide::Settings& collision() const;  // the scene's, with the cell size in use
  /// Returns the default cell size (§2.2) with these levels. It depends on the rest shapes of the bodies, or on those
  /// of the first frame of a recording, not on the present ones.
  glm::vec3 default_cell_size(int levels) const;
  const collide::Method& method() const;
  const IntegratorChoice& integrator_choice() const;
  const Plan& plan() const;
  int frame() const;  // steps done; of a recording: its frame, from 0
  double frame_time() const;

  // The current state, of the meshes that are shown (BodyModel::shown()).
  const collide::Bodies& bodies() const;
  collide::Frame positions() const;  // in the world, valid until the next change
  SimulatedMeshes simulated() const;
  Particle particle(BodyId body, Index vertex) const;
  BodyState body(BodyId body) const;
  const BodyModel& model(BodyId body) const;
  const collide::Result& detection() const;   // at positions()
  const collide::Detector& detector() const;  // for its debug()
  bool all_at_rest() const;                   // no step moves a body: all are asleep, and none is still to come
  const State& state() const;                 // of all particles
  std::uint64_t state_hash() const;           // over the bits of positions and velocities, in the order of bodies

  // The last step.
  const StepReport& last_step() const;
  std::vector<SurfaceContactPoint> surface_contacts() const;  // if all bodies sleep: of the last substep before

 private:
  friend struct WorldTestAccess;  // for tests of the solver
  struct Parts;
  struct DeleteParts {
    void operator()(Parts* parts) const;
  };
  std::unique_ptr<Parts, DeleteParts> parts_;
};

/// Returns the scene's bodies and the added ones. A world of a scene with these bodies moves the same way, to the bit,
/// if nothing else was changed by hand and if adding bodies did not change the plan.
std::vector<BodySource> body_sources(const World& world);

}  // namespace softbody
